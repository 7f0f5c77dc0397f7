// The hyper-parameters and options of support vector regression.
#pragma once

#include <cstdint>
#include <optional>

namespace remapc {

// Hyper-parameters of one output, in normalised units: alpha (or alpha / (alpha + alpha_pole)) and the output
// are scaled to [0, 1] over the training rows, specular to [0, specular_span]. Target specular is curved in
// alpha, mostly near 0, and nearly straight in specular. With a pole and a span below 1, one gamma fits both
// inputs.
struct SvrHyperParameters {
  double cost = 100.0;         // C, the penalty of errors above epsilon; > 0
  double gamma = 1.0;          // of exp(-gamma |x - y|^2); > 0
  double epsilon = 1e-3;       // half width of the tube without penalty; > 0
  double specular_span = 1.0;  // (0, 1]; unused if alpha is the only input
  double alpha_pole = 0.0;     // at least 0, in units of alpha; 0: no transform
  bool operator==(const SvrHyperParameters&) const = default;
};

struct SvrOptions {
  std::uint64_t seed = 1;  // of the folds of the search and of the drawn samples
  unsigned jobs = 0;       // threads; 0: one per core. The result does not depend on it
  // Missing hyper-parameters are searched.
  std::optional<SvrHyperParameters> alpha, specular;
};

}  // namespace remapc
