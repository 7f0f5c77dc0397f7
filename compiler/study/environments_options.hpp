// Options of the environments study.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/fit.hpp"
#include "report/environment.hpp"
#include "report/lit_sphere.hpp"

namespace remapc {

struct ModelPair {
  std::string source, target;
};

// Returns `source -> target`.
std::string pair_name(const ModelPair& pair);

enum class Method {
  kCopy,     // alpha and specular are copied
  kPaper,    // match by the objective `paper`
  kNatural,  // match by the objective `natural`
  kShipped,  // a fit, evaluated as generated headers and texremap do
  kBest,     // least mean RMSE over the given environments; no conversion can be better
};
std::string method_name(Method method);

// `progress` is called progress_steps() times.
struct EnvironmentsOptions : SphereSampling {
  std::vector<ModelPair> pairs;           // models of the built-in renderer
  std::vector<double> alphas;             // of the source
  double specular = 0.5;                  // of the source, linear, above 0 to 1
  std::vector<Environment> environments;  // of different names and equal mean luminance
  std::vector<remap::Fit> fits;           // fits for kShipped
  int match_resolution = 512;             // width and height of the pictures for kPaper and kNatural
  bool least_error = false;               // compare kBest, too
  std::optional<double> sheet_alpha;      // one of `alphas`: draw contact sheets of it
};

// The target parameters for one source material.
struct Conversion {
  std::size_t pair = 0;  // index into EnvironmentsOptions::pairs
  Method method = Method::kCopy;
  double alpha = 0.0;  // of the source
  double target_alpha = 0.0, target_specular = 0.0;
};

}  // namespace remapc
