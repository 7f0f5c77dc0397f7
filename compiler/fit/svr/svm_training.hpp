// One training by libsvm. svm_training.cpp is the only file that uses libsvm.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fit/svr/svr_options.hpp"
#include "remap/mapping.hpp"

namespace remapc {

// Samples of one output: alpha unchanged, specular and output normalised to [0, 1].
struct SvrSamples {
  std::size_t input_count = 1;  // 1: alpha; 2: alpha, specular
  std::vector<double> inputs;   // rows of input_count values
  std::vector<double> outputs;  // one per sample
  std::size_t count() const noexcept { return outputs.size(); }
};

// Trains an epsilon-SVR with Gaussian kernel on `samples` (at least 1, finite). Alpha is normalised over the
// samples and specular is multiplied by specular_span. The result contains these scalings, so it has the
// units of `samples`. Empty if libsvm stopped at its limit of 10^7 iterations or found no finite solution.
// Thread-safe; the same samples in the same order give the same bits. Throws kUsage if libsvm refuses the
// hyper-parameters.
std::optional<remap::KernelExpansion> train_expansion(const SvrSamples& samples,
                                                      const SvrHyperParameters& parameters);

// For example `libsvm 3.24`.
std::string solver_name();

}  // namespace remapc
