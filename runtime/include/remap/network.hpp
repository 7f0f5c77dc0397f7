// Fully connected networks.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "remap/named_values.hpp"

namespace remap {

// normalised = (t - offset) * scale, with t = value, or t = value / (value + pole), which spreads values near
// 0, where curves over alpha bend most.
struct Scaling {
  double offset = 0.0;
  double scale = 1.0;  // not 0
  double pole = 0.0;   // >= 0; 0: t = value. Outputs have none
  bool operator==(const Scaling&) const = default;
};

enum class Activation { kRelu, kTanh, kSilu };
inline constexpr NamedValues<Activation, 3> kActivations = {
    {{Activation::kRelu, "relu"}, {Activation::kTanh, "tanh"}, {Activation::kSilu, "silu"}}};
inline std::string_view activation_name(Activation activation) { return name_of(kActivations, activation); }

// One layer: outputs = weights inputs + biases.
struct Layer {
  std::size_t input_count = 0;
  std::vector<double> weights;  // one row of input_count per output
  std::vector<double> biases;   // one per output
  std::size_t output_count() const noexcept { return biases.size(); }
  bool operator==(const Layer&) const = default;
};

// A fully connected network of normalised inputs and outputs, with `activation` after every layer but the
// last.
struct Network {
  Activation activation = Activation::kTanh;
  std::vector<Scaling> inputs;
  std::vector<Scaling> outputs;
  std::vector<Layer> layers;  // at least 1
  bool operator==(const Network&) const = default;
};

}  // namespace remap
