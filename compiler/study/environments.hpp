// The environments study: compares pictures of source and converted spheres under environment maps, for
// several methods of conversion.
#pragma once

#include <string>
#include <vector>

#include "study/conversions.hpp"

namespace remap {

// The pairs and alphas whose figures the documentation states.
std::vector<StudyPair> default_pairs();
std::vector<double> default_alphas();

// The number of calls of `progress`.
std::size_t progress_steps(const EnvironmentsOptions& options);

// The difference between two pictures over the pixels that show the sphere.
struct EnvironmentComparison {
  Conversion conversion;
  std::size_t environment = 0;  // index into EnvironmentsOptions::environments
  double rmse = 0.0;            // of display values over all channels, percent of the display range
  double ssim = 0.0;            // of luma; 1 for equal pictures
  double energy = 0.0;          // mean linear luminance of the target over that of the source, minus 1
  double squared_noise = 0.0;   // mean square sampling error of the difference, display values
};

struct EnvironmentsResult {
  std::vector<EnvironmentComparison> comparisons;  // sorted by alpha, pair, method, environment
  // One labelled sheet for each environment if `sheet_alpha` is set, in display values: one row for each
  // pair; the source, then the result of each method. Dark where a method does not apply to a pair.
  std::vector<Image> sheets;
};

// Compares every pair, alpha, method and environment. Pairs without a fit have no comparisons of kShipped.
// Throws kUsage for unknown models, numbers out of range, empty lists and repeated environment names,
// kNumeric if a fit cannot be lowered, and kInterrupted.
EnvironmentsResult study_environments(const EnvironmentsOptions& options);

// A row for each comparison. The comments are the settings and the sampling noise: the RMS error of the
// difference of two compared pictures, which adds to an RMSE in squares.
std::string environments_csv(const EnvironmentsOptions& options, const EnvironmentsResult& result);

}  // namespace remap
