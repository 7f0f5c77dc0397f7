// The study of environments: how alike source and converted spheres look under environment light, for ways to
// convert parameters.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/fit.hpp"
#include "study/environment.hpp"

namespace remapc {

struct ModelPair {
  std::string source, target;
};

// `a -> b`, as people read it.
std::string pair_name(const ModelPair& pair);

enum class Method {
  kCopy,     // alpha and specular are taken over as they are
  kPaper,    // matched by the objective `paper`
  kNatural,  // matched by the objective `natural`
  kShipped,  // a fit, lowered to the polynomials in floats that a header and texremap evaluate
  kBest,     // of least mean RMSE over the given environments: what no conversion can do better
};
std::string method_name(Method method);

struct EnvironmentsOptions {
  std::vector<ModelPair> pairs;           // of models of the built-in renderer
  std::vector<double> alphas;             // of the source
  double specular = 0.5;                  // of the source, linear
  std::vector<Environment> environments;  // names differ; of one mean luminance
  std::vector<remap::Fit> fits;           // what kShipped may use
  int resolution = 128;                   // of the pictures, pixels
  int samples = 1024;                     // directions a pixel
  int match_resolution = 512;             // of the pictures that paper and natural are matched by
  unsigned jobs = 0;                      // threads; 0: one a core
  bool floor = false;                     // compare kBest too
  std::optional<double> sheet_alpha;      // of `alphas`: spheres of this width are kept for contact sheets
  std::function<void()> progress;         // one of progress_steps() is done; from any thread
  const std::atomic<bool>* cancelled = nullptr;  // stops soon; throws kInterrupted
};

// The pairs and widths whose figures this project states.
std::vector<ModelPair> default_pairs();
std::vector<double> default_alphas();

// How many times `progress` will be called.
std::size_t progress_steps(const EnvironmentsOptions& options);

// What a source material becomes.
struct Conversion {
  std::size_t pair = 0;  // index into EnvironmentsOptions::pairs
  Method method = Method::kCopy;
  double alpha = 0.0;  // of the source
  double target_alpha = 0.0, target_specular = 0.0;
};

// How far the pictures of source and target are apart, over the pixels that show the sphere.
struct PictureLikeness {
  double rmse = 0.0;    // of display values, all channels; percent of the display's range
  double ssim = 0.0;    // structural similarity of luma, 1 for equal pictures
  double energy = 0.0;  // mean radiance of the target relative to the source's, less 1; linear luminance
};

struct EnvironmentComparison {
  Conversion conversion;
  std::size_t environment = 0;  // index into EnvironmentsOptions::environments
  PictureLikeness likeness;
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
PictureLikeness mean_likeness(const std::vector<const EnvironmentComparison*>& comparisons);

// The comparisons of one method, of one pair where `pair` is an index.
inline constexpr std::size_t kAllPairs = static_cast<std::size_t>(-1);
std::vector<const EnvironmentComparison*> comparisons_of(const EnvironmentsResult& result, Method method,
                                                         std::size_t pair = kAllPairs);

}  // namespace remapc
