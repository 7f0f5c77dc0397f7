// This file is the environments study. For several methods of conversion, it compares pictures of the source
// and of the converted sphere under environment maps. It also finds the best materials, whose pictures are
// the most similar to the source's. No conversion of parameters can do better.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "look/environment.hpp"
#include "look/lit_sphere.hpp"
#include "lower/fit.hpp"
#include "measure/sweep_options.hpp"

namespace remap {

struct StudyPair {
  std::string source, target;
};

enum class Method {
  kCopy,      // alpha and specular are copied
  kPaper,     // match by the objective `paper`
  kNatural1,  // match by the objective `natural-1`
  kNatural2,  // match by the objective `natural-2`
  kShipped,   // converted by a fit (lower/interpreter.hpp)
  kBest,      // least mean RMSE over the given environments; no conversion can be better
};

// An EnvironmentsOptions holds the options. `progress` is called progress_steps() times.
struct EnvironmentsOptions : SphereSampling {
  std::vector<StudyPair> pairs;           // models of the built-in renderer
  std::vector<double> alphas;             // alphas of the source
  double specular = 0.5;                  // specular of the source, linear, above 0 to 1
  double diffuse = 0.0;                   // diffuse of both models, linear, 0 to 1
  std::vector<Environment> environments;  // with different names and equal mean luminance
  std::vector<Fit> fits;                  // fits for kShipped
  int match_resolution = 512;             // width and height of the pictures of the matches
  bool least_error = false;               // also compare kBest
  std::optional<double> sheet_alpha;      // an alpha in `alphas`, for which contact sheets are drawn
};

// A Conversion holds the target parameters for one source material.
struct Conversion {
  std::size_t pair = 0;  // index into EnvironmentsOptions::pairs
  Method method = Method::kCopy;
  double alpha = 0.0;  // alpha of the source
  double target_alpha = 0.0, target_specular = 0.0;
};

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
