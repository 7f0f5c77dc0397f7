// What the study of environments found, as tables, a plot and words.
#pragma once

#include <string>
#include <vector>

#include "study/environments.hpp"

namespace remapc {

// The methods that have comparisons, in the order of Method.
std::vector<Method> methods_of(const EnvironmentsResult& result);

// CSV: `#` lines on how it was measured, then a row for each comparison.
std::string comparisons_csv(const EnvironmentsOptions& options, const EnvironmentsResult& result);

// CSV: the means of each method, over all of its pairs (`all`) and for each of them.
std::string summary_csv(const EnvironmentsOptions& options, const EnvironmentsResult& result);

// The means as text, and in words which pairs look less alike than copies do, and what was left out.
std::string summary_text(const EnvironmentsOptions& options, const EnvironmentsResult& result);

// A pair that a method makes look less alike than copying does: a larger RMSE or a smaller SSIM, in the mean
// over alphas and environments, by more than half the last digit of the text.
struct WorsePair {
  Method method = Method::kPaper;
  std::size_t pair = 0;
  PictureSimilarity image_similarity, copy;
};
std::vector<WorsePair> worse_than_copy(const EnvironmentsOptions& options, const EnvironmentsResult& result);

// A script for gnuplot that draws RMSE and SSIM over alpha as SVG, means over pairs and environments, of each
// method that has all pairs.
std::string plot_script(const EnvironmentsOptions& options, const EnvironmentsResult& result);

}  // namespace remapc
