// The results of the environments study as tables, a plot and a summary.
#pragma once

#include <string>
#include <vector>

#include "study/environments.hpp"

namespace remapc {

// The methods that have comparisons, in the order of Method.
std::vector<Method> methods_of(const EnvironmentsResult& result);

// CSV: `#` lines with the settings, then one row for each comparison.
std::string comparisons_csv(const EnvironmentsOptions& options, const EnvironmentsResult& result);

// CSV: the means of each method, over all of its pairs (`all`) and for each pair.
std::string summary_csv(const EnvironmentsOptions& options, const EnvironmentsResult& result);

// The means as text, the pairs for which a method is worse than copying, and the remarks.
std::string summary_text(const EnvironmentsOptions& options, const EnvironmentsResult& result);

// A pair for which a method is worse than copying: its mean RMSE over alphas and environments is larger, or
// its mean SSIM smaller, by more than half the last digit of the text.
struct WorsePair {
  Method method = Method::kPaper;
  std::size_t pair = 0;
  PictureSimilarity image_similarity, copy;
};
std::vector<WorsePair> worse_than_copy(const EnvironmentsOptions& options, const EnvironmentsResult& result);

// A gnuplot script that draws RMSE and SSIM over alpha as SVG: means over pairs and environments of each
// method that applies to all pairs.
std::string plot_script(const EnvironmentsOptions& options, const EnvironmentsResult& result);

}  // namespace remapc
