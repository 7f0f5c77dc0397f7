// Samples on their way into a training: normalised, in a seeded order, split into those that train and those
// that judge.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "fit/network/samples.hpp"
#include "model/mapping.hpp"

namespace remapc {

struct NormalisedSamples {
  std::vector<remap::Scaling> input_scalings, output_scalings;
  Eigen::MatrixXd inputs, outputs;  // one column a sample, in an order drawn by the seed
};

// Inputs to [-1, 1], outputs to mean 0 and variance 1 over all samples; what is constant is only shifted.
NormalisedSamples normalised_samples(const Samples& samples, std::uint64_t seed);

// Normalised samples, one column each. Training adjusts the parameters, validation says when to stop.
struct NetworkSamples {
  Eigen::MatrixXd training_inputs, training_outputs;
  Eigen::MatrixXd validation_inputs, validation_outputs;
};

// The first `validation_fraction` of the samples judge (at least one, at most 4096), the next train, at most
// `most_training` of them. With a fraction of 0 those that train judge.
NetworkSamples split_columns(const NormalisedSamples& all, double validation_fraction,
                             std::size_t most_training);

// A seed of its own for each purpose `stream` (splitmix64, Steele et al. 2014).
std::uint64_t mixed_seed(std::uint64_t seed, std::uint64_t stream);

}  // namespace remapc
