// The hyper-parameters of support vector regression, and what a caller may choose.
#pragma once

#include <cstdint>
#include <optional>

namespace remapc {

// Of one output, in normalised units: alpha (or alpha / (alpha + alpha_pole)) and the output are scaled to
// [0, 1] over the training rows, specular to [0, specular_span]. Target specular bends over alpha, most near
// 0, and is nearly straight over specular: a pole and a span below 1 let one gamma serve all of it.
struct SvrHyperParameters {
  double cost = 100.0;         // C, penalty of an error beyond epsilon; > 0
  double gamma = 1.0;          // of exp(-gamma |x - y|^2); > 0
  double epsilon = 1e-3;       // half width of the tube without penalty; > 0
  double specular_span = 1.0;  // (0, 1]; without meaning where alpha is the only input
  double alpha_pole = 0.0;     // from 0, in units of alpha; 0: alpha itself
  bool operator==(const SvrHyperParameters&) const = default;
};

struct SvrOptions {
  std::uint64_t seed = 1;  // of the folds that choose the hyper-parameters, and of samples drawn from many
  unsigned jobs = 0;       // threads; 0: one a processor. The result does not depend on it
  // Given hyper-parameters are taken as they are; missing ones are searched.
  std::optional<SvrHyperParameters> alpha, specular;
};

}  // namespace remapc
