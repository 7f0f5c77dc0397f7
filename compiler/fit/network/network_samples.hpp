// Prepares samples for a training: normalises and shuffles them, and splits them into training and validation
// samples.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "fit/network/samples.hpp"
#include "remap/mapping.hpp"

namespace remapc {

struct NormalisedSamples {
  std::vector<remap::Scaling> input_scalings, output_scalings;
  Eigen::MatrixXd inputs, outputs;  // one column per sample, in random order
};

// Scales inputs to [-1, 1] and outputs to mean 0 and variance 1 over all samples. Constant values are only
// shifted.
NormalisedSamples normalised_samples(const Samples& samples, std::uint64_t seed);

// Normalised samples, one column each. Validation samples determine when the training stops.
struct NetworkSamples {
  Eigen::MatrixXd training_inputs, training_outputs;
  Eigen::MatrixXd validation_inputs, validation_outputs;
};

// Splits the samples: the first `validation_fraction` of them (1 to 2048) are validation samples, the
// following ones (at most `most_training`) training samples. With a fraction of 0 the training samples are
// also the validation samples.
NetworkSamples split_columns(const NormalisedSamples& all, double validation_fraction,
                             std::size_t most_training);

// Derives a seed for each purpose `stream` (splitmix64, Steele et al. 2014).
std::uint64_t mixed_seed(std::uint64_t seed, std::uint64_t stream);

}  // namespace remapc
