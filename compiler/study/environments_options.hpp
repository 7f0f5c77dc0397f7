// What the study of environments compares.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/fit.hpp"
#include "report/environment.hpp"

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
  bool least_error = false;               // compare kBest too
  std::optional<double> sheet_alpha;      // of `alphas`: spheres of this width are kept for contact sheets
  std::function<void()> progress;         // one of progress_steps() is done; from any thread
  const std::atomic<bool>* cancelled = nullptr;  // stops soon; throws kInterrupted
};

// What a source material becomes.
struct Conversion {
  std::size_t pair = 0;  // index into EnvironmentsOptions::pairs
  Method method = Method::kCopy;
  double alpha = 0.0;  // of the source
  double target_alpha = 0.0, target_specular = 0.0;
};

}  // namespace remapc
