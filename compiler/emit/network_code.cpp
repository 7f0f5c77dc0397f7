// This file writes networks as code. The code loops over the units of each layer, and innermost over rows of
// texels.
#include "emit/header_data.hpp"
#include "formula/text_template.hpp"

namespace remap {
namespace {

constexpr std::size_t kCacheFloats = 6144;  // size of all rows: 24 of the 32 KB of a first-level cache
constexpr std::size_t kUnitsAtOnce = 4;     // hidden units that `two_layers` (layers.in) computes together

std::string layer_table(const std::string& name, const Layer& layer) {
  std::vector<std::string> numbers;
  for (std::size_t j = 0; j < layer.output_count(); ++j) {
    numbers.push_back(literal(layer.biases[j]));
    for (std::size_t k = 0; k < layer.input_count; ++k)
      numbers.push_back(literal(layer.weights[j * layer.input_count + k]));
  }
  return table_code(name, layer.input_count + 1, numbers);
}

// Returns the calls that compute each layer from the rows of the previous layer. `last` receives the name of
// the last rows.
std::string layer_calls(const std::string& name, const std::vector<Layer>& layers, std::string* last) {
  const auto table = [&](std::size_t l) { return "k_" + name + "_" + std::to_string(l); };
  const auto units = [&](std::size_t l) { return std::to_string(layers[l].output_count()); };
  const auto inputs = [&](std::size_t l) { return std::to_string(layers[l].input_count); };
  std::string calls, in = "x0";
  for (std::size_t l = layers.size() == 1 ? 0 : 1; l < layers.size(); ++l) {
    const std::string out = "x" + std::to_string(l + 1);
    calls += "float " + out + "[" + units(l) + "][kBlock];\n";
    if (l == 1) {
      calls += "two_layers<" + inputs(0) + ", " + units(0) + ", " + units(1) + ">(count, " + table(0) + ", " +
               table(1) + ", x0, " + out + ");\n";
    } else {
      if (l > 1) calls += "activate<" + units(l - 1) + ">(count, " + in + ");\n";
      calls +=
          "layer<" + inputs(l) + ", " + units(l) + ">(count, " + table(l) + ", " + in + ", " + out + ");\n";
    }
    in = out;
  }
  *last = in;
  return calls;
}

}  // namespace

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

std::string network_helpers(Activation activation) {
  const std::string_view name = activation_name(activation);
  return (activation == Activation::kRelu ? code_files({name}) : code_files({"tangent", name})) + "\n" +
         fill_template(code_file("layers"), {{"at_once", std::to_string(kUnitsAtOnce)}});
}

std::string network_function(const std::string& name, const Network& network) {
  std::string tables, poles, last;
  for (std::size_t k = 0; k < network.inputs.size(); ++k) {
    if (network.inputs[k].pole == 0.0) continue;
    const std::string row = "x0[" + std::to_string(k) + "][i]";
    poles += "for (std::size_t i = 0; i < count; ++i) " + row + " = " + row + " / (" + row + " + " +
             literal(network.inputs[k].pole) + ");\n";
  }
  for (std::size_t l = 0; l < network.layers.size(); ++l)
    tables += layer_table("k_" + name + "_" + std::to_string(l), network.layers[l]);
  const std::string calls = layer_calls(name, network.layers, &last);
  return "\n" + fill_template(code_file("network"), {{"tables", tables},
                                                     {"name", name},
                                                     {"inputs", std::to_string(network.inputs.size())},
                                                     {"outputs", std::to_string(network.outputs.size())},
                                                     {"poles", poles},
                                                     {"layers", calls},
                                                     {"last", last}});
}

int network_block(const Network& network) {
  std::size_t rows = network.inputs.size() + kUnitsAtOnce, block = 128;
  for (std::size_t l = 1; l < network.layers.size(); ++l) rows += network.layers[l].output_count();
  while (block > 16 && block * rows > kCacheFloats) block /= 2;
  return static_cast<int>(block);
}

}  // namespace remap
