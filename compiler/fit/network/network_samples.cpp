#include "fit/network/network_samples.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fit/rows/split.hpp"

namespace remapc {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using remap::Scaling;

constexpr std::size_t kMostValidationRows = 2048;

// One column per sample.
Eigen::Map<const MatrixXd> columns_of(const std::vector<double>& values, std::size_t width) {
  return {values.data(), static_cast<Index>(width), static_cast<Index>(values.size() / width)};
}

// Scales values to [-1, 1].
Scaling range_scaling(const VectorXd& values) {
  const double low = values.minCoeff(), high = values.maxCoeff();
  if (!(high > low)) return {low, 1.0};
  return {low + 0.5 * (high - low), 2.0 / (high - low)};
}

// Scales values to mean 0 and variance 1.
Scaling variance_scaling(const VectorXd& values) {
  if (!(values.maxCoeff() > values.minCoeff())) return {values[0], 1.0};
  const double mean = values.mean();
  const double deviation = std::sqrt((values.array() - mean).square().mean());
  if (!(deviation > 0.0)) return {mean, 1.0};
  return {mean, 1.0 / deviation};
}

MatrixXd normalised_columns(const Eigen::Map<const MatrixXd>& values, const std::vector<Scaling>& scalings) {
  MatrixXd result = values;
  for (Index i = 0; i < result.rows(); ++i) {
    const Scaling& scaling = scalings[static_cast<std::size_t>(i)];
    result.row(i) = (result.row(i).array() - scaling.offset) * scaling.scale;
  }
  return result;
}

}  // namespace

std::uint64_t mixed_seed(std::uint64_t seed, std::uint64_t stream) {
  std::uint64_t z = seed + (stream + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

NormalisedSamples normalised_samples(const Samples& samples, std::uint64_t seed) {
  const auto inputs = columns_of(samples.inputs, samples.input_count);
  const auto outputs = columns_of(samples.outputs, samples.output_count);
  NormalisedSamples result;
  for (Index i = 0; i < inputs.rows(); ++i) result.input_scalings.push_back(range_scaling(inputs.row(i)));
  for (Index i = 0; i < outputs.rows(); ++i)
    result.output_scalings.push_back(variance_scaling(outputs.row(i)));
  const std::vector<std::size_t> order = seeded_order(samples.count(), mixed_seed(seed, 0));
  result.inputs = normalised_columns(inputs, result.input_scalings)(Eigen::all, order);
  result.outputs = normalised_columns(outputs, result.output_scalings)(Eigen::all, order);
  return result;
}

NetworkSamples split_columns(const NormalisedSamples& all, double validation_fraction,
                             std::size_t most_training) {
  const auto count = static_cast<std::size_t>(all.inputs.cols());
  auto validation = static_cast<std::size_t>(std::lround(validation_fraction * static_cast<double>(count)));
  if (validation_fraction > 0.0) validation = std::clamp(validation, std::size_t{1}, kMostValidationRows);
  const auto from = static_cast<Index>(validation);
  const auto training = static_cast<Index>(std::min(count - validation, most_training));
  NetworkSamples samples{all.inputs.middleCols(from, training), all.outputs.middleCols(from, training),
                         all.inputs.leftCols(from), all.outputs.leftCols(from)};
  if (validation == 0) {
    samples.validation_inputs = samples.training_inputs;
    samples.validation_outputs = samples.training_outputs;
  }
  return samples;
}

}  // namespace remapc
