// This file runs one training by libsvm. svm_training.cpp is the only file that uses libsvm.
#pragma once

#include <optional>
#include <string>

#include "lower/mapping.hpp"
#include "table/regression.hpp"

namespace remap {

// An SvrHyperParameters holds the hyper-parameters of one output, in normalised units. Alpha (or alpha /
// (alpha + alpha_pole)) and the output are scaled to [0, 1] over the training rows, and specular to [0,
// specular_span]. Target specular as a function of alpha is curved, mostly close to 0. As a function of
// specular, it is nearly straight. With a pole and a span below 1, one gamma fits both inputs.
struct SvrHyperParameters {
  double cost = 100.0;         // C, the penalty of errors above epsilon; > 0
  double gamma = 1.0;          // for exp(-gamma |x - y|^2); > 0
  double epsilon = 1e-3;       // half width of the tube without penalty; > 0
  double specular_span = 1.0;  // (0, 1]; unused if alpha is the only input
  double alpha_pole = 0.0;     // at least 0, in units of alpha; 0: no transform
  bool operator==(const SvrHyperParameters&) const = default;
};

// Trains an epsilon-SVR with Gaussian kernel on `samples` (at least 1, finite) of one output. Their inputs
// are alpha, or alpha and specular. Alpha is unchanged, specular and output are normalised to [0, 1]. Alpha
// is normalised over the samples and specular is multiplied by specular_span. The result contains these
// scalings, so it has the units of `samples`. Returns nothing if libsvm stopped at its limit of 10^7
// iterations or found no finite solution. Thread-safe; the same samples in the same order give the same bits.
// Throws kUsage if libsvm refuses the hyper-parameters.
std::optional<KernelExpansion> train_expansion(const Samples& samples, const SvrHyperParameters& parameters);

// Returns for example `libsvm 3.24`.
std::string solver_name();

}  // namespace remap
