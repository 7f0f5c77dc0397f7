// One training by libsvm. The file behind this is the only one that touches it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fit/svr/svr_options.hpp"
#include "model/mapping.hpp"

namespace remapc {

// Samples of one output: raw alpha, specular and output normalised to [0, 1].
struct SvrSamples {
  std::size_t input_count = 1;  // 1: alpha; 2: alpha, specular
  std::vector<double> inputs;   // one row of input_count after the other
  std::vector<double> outputs;  // one a sample
  std::size_t count() const noexcept { return outputs.size(); }
};

// Trains an epsilon-SVR with Gaussian kernel on `samples` (at least 1, finite). Alpha is
// normalised over the samples, specular counts specular_span-fold; the scalings of the result say so, and it
// takes and gives `samples`' own units. None where libsvm gave up after its bound of 10^7 iterations or found
// no finite answer. May be called from many threads; the same samples in the same order give the same bits.
// Throws kUsage where libsvm refuses the hyper-parameters.
std::optional<remap::KernelExpansion> train_expansion(const SvrSamples& samples,
                                                      const SvrHyperParameters& parameters);

// "libsvm 3.24".
std::string solver_name();

}  // namespace remapc
