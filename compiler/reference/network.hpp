// This file holds fully connected networks, and their formula for any type of scalar. The interpreter uses it
// with doubles, and proofs use it with Taylor models. A scalar needs +, -, * with itself and with double, and
// the functions that are declared for double here.
#pragma once

#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "remap/model.hpp"

namespace remap {

// A Scaling computes normalised = (t - offset) * scale, with t = value, or t = value / (value + pole). The
// pole gives more room to values near 0, where curves over alpha bend most.
struct Scaling {
  double offset = 0.0;
  double scale = 1.0;  // not 0
  double pole = 0.0;   // at least 0; if 0, t is the value; outputs have no pole
  bool operator==(const Scaling&) const = default;
};

enum class Activation { kRelu, kTanh, kSilu };
inline constexpr NamedValues<Activation, 3> kActivations = {
    {{Activation::kRelu, "relu"}, {Activation::kTanh, "tanh"}, {Activation::kSilu, "silu"}}};
inline std::string_view activation_name(Activation activation) { return name_of(kActivations, activation); }

// A Layer is outputs = weights inputs + biases.
struct Layer {
  std::size_t input_count = 0;
  std::vector<double> weights;  // a row of input_count numbers for each output
  std::vector<double> biases;   // one number for each output
  std::size_t output_count() const noexcept { return biases.size(); }
  bool operator==(const Layer&) const = default;
};

// A Network is fully connected. Its inputs and outputs are normalised, and `activation` follows all layers
// except the last.
struct Network {
  Activation activation = Activation::kTanh;
  std::vector<Scaling> inputs;
  std::vector<Scaling> outputs;
  std::vector<Layer> layers;  // at least 1
  bool operator==(const Network&) const = default;
};

inline double reciprocal(double x) { return 1.0 / x; }
inline double hyperbolic_tangent(double x) { return std::tanh(x); }
inline double rectified(double x) { return x > 0.0 ? x : 0.0; }

template <typename Scalar>
Scalar normalised(const Scaling& scaling, const Scalar& value) {
  if (scaling.pole == 0.0) return (value - scaling.offset) * scaling.scale;
  return (reciprocal(value + scaling.pole) * -scaling.pole + (1.0 - scaling.offset)) * scaling.scale;
}

template <typename Scalar>
Scalar scaled_back(const Scaling& scaling, const Scalar& value) {
  return value * (1.0 / scaling.scale) + scaling.offset;
}

template <typename Scalar>
Scalar activated(Activation activation, const Scalar& x) {
  switch (activation) {
    case Activation::kRelu:
      return rectified(x);
    case Activation::kTanh:
      return hyperbolic_tangent(x);
    case Activation::kSilu:  // x / (1 + exp(-x))
      return x * (hyperbolic_tangent(x * 0.5) * 0.5 + 0.5);
  }
  return x;
}

template <typename Scalar>
std::vector<Scalar> network_outputs(const Network& network, std::vector<Scalar> values) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = normalised(network.inputs[i], values[i]);
  for (std::size_t l = 0; l < network.layers.size(); ++l) {
    const Layer& layer = network.layers[l];
    const bool last = l + 1 == network.layers.size();
    std::vector<Scalar> outputs;
    outputs.reserve(layer.output_count());
    const double* weight = layer.weights.data();
    for (const double bias : layer.biases) {
      Scalar sum = values[0] * *weight++ + bias;
      for (std::size_t i = 1; i < layer.input_count; ++i) sum = sum + values[i] * *weight++;
      outputs.push_back(last ? sum : activated(network.activation, sum));
    }
    values = std::move(outputs);
  }
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = scaled_back(network.outputs[i], values[i]);
  return values;
}

}  // namespace remap
