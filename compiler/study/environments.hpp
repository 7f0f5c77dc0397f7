// The study of environments: how alike source and converted spheres look under environment light, for ways to
// convert parameters.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "report/environment.hpp"
#include "study/environments_options.hpp"

namespace remapc {

// The pairs and widths whose figures this project states.
std::vector<ModelPair> default_pairs();
std::vector<double> default_alphas();

// How many times `progress` will be called.
std::size_t progress_steps(const EnvironmentsOptions& options);

// How far the pictures of source and target are apart, over the pixels that show the sphere.
struct PictureSimilarity {
  double rmse = 0.0;    // of display values, all channels; percent of the display's range
  double ssim = 0.0;    // structural similarity of luma, 1 for equal pictures
  double energy = 0.0;  // mean radiance of the target relative to the source's, less 1; linear luminance
};

struct EnvironmentComparison {
  Conversion conversion;
  std::size_t environment = 0;  // index into EnvironmentsOptions::environments
  PictureSimilarity image_similarity;
  double squared_noise = 0.0;  // mean square sampling error of the difference of the pictures, display values
};

struct EnvironmentsResult {
  std::vector<EnvironmentComparison> comparisons;  // by alpha, pair, method, environment
  std::vector<std::string> remarks;                // what was left out, a sentence each
  // For each environment where `sheet_alpha` is given, in display values: a row a pair; the source, then what
  // it becomes by each method. Dark where a pair has no such method.
  std::vector<Image> sheets;
  // RMS sampling error of the difference of two pictures that are compared, percent of the display's range.
  // What it adds to an RMSE, it adds in squares.
  double noise = 0.0;
};

// Compares every pair, alpha, method and environment. Pairs without a fit have no comparisons of kShipped,
// and a remark. Throws kUsage for unknown models, numbers out of range, empty lists and names given twice,
// kNumeric where a fit cannot be lowered, kInterrupted.
EnvironmentsResult study_environments(const EnvironmentsOptions& options);

// Means over comparisons; energy is the mean of its magnitude.
PictureSimilarity mean_similarity(const std::vector<const EnvironmentComparison*>& comparisons);

// The comparisons of one method, of one pair where `pair` is an index.
inline constexpr std::size_t kAllPairs = static_cast<std::size_t>(-1);
std::vector<const EnvironmentComparison*> comparisons_of(const EnvironmentsResult& result, Method method,
                                                         std::size_t pair = kAllPairs);

}  // namespace remapc
