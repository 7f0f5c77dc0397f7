// This file prepares networks for the computation in headers.
#include "core/number_text.hpp"
#include "emit/header_data.hpp"

namespace remap {
std::string two_digits(double error) { return number_text(rounded_up(error, 2)); }

Network folded(const Network& network) {
  Network result = network;
  Layer& first = result.layers.front();
  for (std::size_t j = 0; j < first.output_count(); ++j)
    for (std::size_t k = 0; k < first.input_count; ++k) {
      double& weight = first.weights[j * first.input_count + k];
      first.biases[j] -= weight * network.inputs[k].scale * network.inputs[k].offset;
      weight *= network.inputs[k].scale;
    }
  Layer& last = result.layers.back();
  for (std::size_t j = 0; j < last.output_count(); ++j) {
    const double range = 1.0 / network.outputs[j].scale;
    for (std::size_t k = 0; k < last.input_count; ++k) last.weights[j * last.input_count + k] *= range;
    last.biases[j] = last.biases[j] * range + network.outputs[j].offset;
  }
  for (Scaling& input : result.inputs) input = {0.0, 1.0, input.pole};
  for (Scaling& output : result.outputs) output = {};
  return result;
}

}  // namespace remap
