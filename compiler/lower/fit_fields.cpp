#include "lower/fit_fields.hpp"

#include "lower/limits.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

Layer read_layer(const Field& field, std::size_t input_count) {
  Layer layer{input_count, field["weights"].numbers(1), field["biases"].numbers(1)};
  field["weights"].require(layer.weights.size() == layer.biases.size() * input_count,
                           "a number for each bias and each of " + std::to_string(input_count) + " inputs");
  return layer;
}

std::string outputs_text(std::size_t count) {
  return count == 1 ? "one output" : std::to_string(count) + " outputs";
}

}  // namespace

Json numbers_json(const std::vector<double>& numbers) {
  Json list = Json::list();
  for (const double number : numbers) list.push_back(finite(number));
  return list;
}

Json scaling_json(const Scaling& scaling) {
  return {
      {"offset", finite(scaling.offset)}, {"scale", finite(scaling.scale)}, {"pole", finite(scaling.pole)}};
}

Json scalings_json(const std::vector<Scaling>& scalings) {
  Json list = Json::list();
  for (const Scaling& scaling : scalings) list.push_back(scaling_json(scaling));
  return list;
}

Scaling read_scaling(const Field& field) {
  field["scale"].require(field["scale"].number() != 0.0, "a scale that is not 0");
  field["pole"].require(field["pole"].number() >= 0.0, "a pole from 0");
  return {field["offset"].number(), field["scale"].number(), field["pole"].number()};
}

Scaling read_output_scaling(const Field& field) {
  const Scaling scaling = read_scaling(field);
  field["pole"].require(scaling.pole == 0.0, "0 for an output");
  return scaling;
}

Json network_json(const Network& network) {
  if (const std::string fault = oversize(network); !fault.empty())
    throw Error(ErrorKind::kInput, "network: " + fault);
  Json layers = Json::list();
  for (const Layer& layer : network.layers)
    layers.push_back({{"weights", numbers_json(layer.weights)}, {"biases", numbers_json(layer.biases)}});
  return {{"activation", std::string(activation_name(network.activation))},
          {"inputs", scalings_json(network.inputs)},
          {"outputs", scalings_json(network.outputs)},
          {"layers", layers}};
}

Network read_network(const Field& field, std::size_t output_count) {
  Network network;
  network.activation = field["activation"].named(kActivations, "relu, tanh or silu");
  network.inputs = field["inputs"].list(1, read_scaling);
  network.outputs = field["outputs"].list(1, read_output_scaling);
  field["outputs"].require(network.outputs.size() == output_count, outputs_text(output_count));
  std::size_t width = network.inputs.size();
  network.layers = field["layers"].list(1, [&](const Field& entry) {
    const Layer layer = read_layer(entry, width);
    width = layer.output_count();
    return layer;
  });
  field["layers"].require(width == output_count, "a last layer of " + outputs_text(output_count));
  if (const std::string fault = oversize(network); !fault.empty()) field.fail(fault);
  return network;
}

Json figures_json(const ErrorFigures& figures) {
  return {{"rms", finite(figures.rms)}, {"p99", finite(figures.p99)}, {"max", finite(figures.max)}};
}

ErrorFigures read_figures(const Field& field) {
  return {field["rms"].number(), field["p99"].number(), field["max"].number()};
}

Json split_json(const Split& split) {
  return {{"seed", split.seed},
          {"held_out_fraction", finite(split.held_out_fraction)},
          {"trained_rows", split.trained_rows},
          {"held_out_rows", split.held_out_rows},
          {"left_out", split.left_out}};
}

Split read_split(const Field& field) {
  Split split;
  split.seed = static_cast<std::uint64_t>(field["seed"].count());
  split.held_out_fraction = field["held_out_fraction"].number();
  split.trained_rows = field["trained_rows"].count();
  split.held_out_rows = field["held_out_rows"].count();
  split.left_out =
      field["left_out"].dictionary<std::int64_t>([](const Field& entry) { return entry.count(); });
  return split;
}

Json table_record_json(const TableRecord& table) {
  return {{"name", table.name}, {"sha256", table.sha256}, {"comments", table.comments}};
}

TableRecord read_table_record(const Field& field) {
  return {field["name"].text(), field["sha256"].text(), field["comments"].text_dictionary()};
}

}  // namespace remap
