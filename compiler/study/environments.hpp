// This file is the environments study. It compares pictures of source and converted spheres under environment
// maps, for several methods of conversion.
#pragma once

#include <string>
#include <vector>

#include "study/conversions.hpp"

namespace remap {

// Returns the pairs and alphas whose figures the documentation states.
std::vector<StudyPair> default_pairs();
std::vector<double> default_alphas();

// Returns the number of calls of `progress`.
std::size_t progress_steps(const EnvironmentsOptions& options);

// An EnvironmentComparison is the difference between two pictures over the pixels that show the sphere.
struct EnvironmentComparison {
  Conversion conversion;
  std::size_t environment = 0;  // index into EnvironmentsOptions::environments
  double rmse = 0.0;            // over all channels, percent of the display range
  double ssim = 0.0;            // for luma; 1 for equal pictures
  double energy = 0.0;          // mean linear luminance, target / source - 1
  double squared_noise = 0.0;   // mean square sampling error of the difference, in display values
};

struct EnvironmentsResult {
  std::vector<EnvironmentComparison> comparisons;  // sorted by alpha, pair, method, environment
  // If `sheet_alpha` is set, these are labelled sheets, one per environment. A row shows a pair: the source,
  // then the result of each method. The place of a method that does not apply to the pair is dark.
  std::vector<Image> sheets;
};

// Compares every pair, alpha, method and environment. Pairs without a fit have no comparisons of kShipped.
// Throws kUsage for unknown models, numbers out of range, empty lists and repeated environment names. Throws
// kNumeric if a fit cannot be lowered, and kInterrupted.
EnvironmentsResult study_environments(const EnvironmentsOptions& options);

// Returns a row for each comparison. The comments are the settings and the sampling noise, which is the RMS
// error of the difference of two compared pictures. Its square adds to the square of an RMSE.
std::string environments_csv(const EnvironmentsOptions& options, const EnvironmentsResult& result);

}  // namespace remap
