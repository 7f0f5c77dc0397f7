// This file is the environments study. For several methods of conversion, it compares pictures of the source
// and of the converted sphere under environment maps.
#pragma once

#include <string>
#include <vector>

#include "study/conversions.hpp"

namespace remap {

// Returns the pairs and alphas that the documentation has figures for.
std::vector<StudyPair> default_pairs();
std::vector<double> default_alphas();

// Returns how often `progress` will be called.
std::size_t progress_steps(const EnvironmentsOptions& options);

// An EnvironmentComparison is the difference between two pictures over the pixels that show the sphere.
struct EnvironmentComparison {
  Conversion conversion;
  std::size_t environment = 0;  // index into EnvironmentsOptions::environments
  double rmse = 0.0;            // over all channels, percent of the display range
  double ssim = 0.0;            // for luma; 1 for equal pictures
  double energy = 0.0;          // mean linear luminance, as target / source - 1
  double squared_noise = 0.0;   // mean square sampling error of the difference, in display values
};

// Compares every pair, alpha, method and environment. Pairs without a fit have no comparisons of kShipped.
// Throws kUsage for unknown models, numbers out of range, empty lists and repeated environment names. Throws
// kNumeric if a fit cannot be lowered, and kInterrupted.
//
// The comparisons are sorted by alpha, pair, method and environment. With `sheet_alpha`, `sheets` receives
// sheets with labels, one for each environment. A row shows a pair: the source, then the result of each
// method. If a method does not apply to the pair, its place is dark.
std::vector<EnvironmentComparison> study_environments(const EnvironmentsOptions& options,
                                                      std::vector<Image>* sheets = nullptr);

// Returns a row for each comparison. The comments are the settings and the sampling noise. The noise is the
// RMS error of the difference between two pictures. Its square adds to the square of an RMSE.
std::string environments_csv(const EnvironmentsOptions& options,
                             const std::vector<EnvironmentComparison>& comparisons);

}  // namespace remap
