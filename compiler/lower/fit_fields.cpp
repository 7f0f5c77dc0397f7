#include "lower/fit_fields.hpp"

#include "core/errors.hpp"
#include "lower/fit_file.hpp"

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

Json to_json(const SpecularWorkflow& workflow) {
  return {{"model", workflow.model},
          {"workflow", "specular"},
          {"diffuse", std::string(diffuse_convention_name(workflow.diffuse))},
          {"roughness", std::string(encoding_name(workflow.width))}};
}

Json to_json(const MetallicWorkflow& workflow) {
  return {{"model", workflow.model},
          {"workflow", "metallic"},
          {"dielectric_f0", workflow.dielectric_f0},
          {"diffuse", std::string(diffuse_convention_name(workflow.diffuse))},
          {"roughness", std::string(encoding_name(workflow.width))}};
}

Json to_json(const WorkflowFormula& formula) {
  if (const auto* network = std::get_if<Network>(&formula))
    return {{"kind", "mlp"}, {"network", network_json(*network)}};
  Json json = {{"kind", kWorkflowKind}, {"formula", std::string(formula_name(formula))}};
  if (const auto* projection = std::get_if<Projection>(&formula)) json["prior"] = projection->prior;
  if (const auto* closed = std::get_if<ClosedFormula>(&formula))
    if (const std::string_view mean = name_of(kMetallicMeans, *closed); !mean.empty()) json["mean"] = mean;
  return json;
}

Json to_json(const NetworkTraining& training) {
  return {
      {"method", training.method},
      {"error_on_held_out_rows",
       {{"base_color", figures_json(training.base_color)}, {"metallic", figures_json(training.metallic)}}},
      {"split", split_json(training.split)},
      {"table", table_record_json(training.table)}};
}

NetworkTraining read_training(const Field& field) {
  NetworkTraining training;
  training.method = field["method"].text_dictionary();
  training.base_color = read_figures(field["error_on_held_out_rows"]["base_color"]);
  training.metallic = read_figures(field["error_on_held_out_rows"]["metallic"]);
  training.split = read_split(field["split"]);
  training.table = read_table_record(field["table"]);
  return training;
}

DiffuseConvention read_diffuse(const Field& side) {
  return side["diffuse"].named(kDiffuseConventions, "plain or scaled");
}

RoughnessEncoding read_width(const Field& side) {
  return side["roughness"].named(kRoughnessEncodings, "roughness, glossiness or alpha");
}

WorkflowFormula read_formula(const Field& mapping) {
  if (mapping["kind"].text() == "mlp") return read_network(mapping["network"], 4);
  mapping["kind"].require(mapping["kind"].text() == kWorkflowKind, "workflow or mlp");
  const std::string name = mapping["formula"].text();
  if (name == "equation-2") return ClosedFormula::kEquation2;
  if (name == "projection") return Projection{mapping["prior"].number()};
  if (name == "khronos") return ClosedFormula::kKhronos;
  mapping["formula"].require(name == "equation-3", "equation-2, projection, equation-3 or khronos");
  return mapping["mean"].named(kMetallicMeans, "plain or albedo");
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
  if (const std::string fault = oversize(network); !fault.empty()) throw input_error("network: " + fault);
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

SpecularWorkflow read_specular_workflow(const Field& side) {
  side["workflow"].require(side["workflow"].text() == "specular", "\"specular\" on this side of the formula");
  return {read_model(side["model"]), read_diffuse(side), read_width(side)};
}

MetallicWorkflow read_metallic_workflow(const Field& side) {
  side["workflow"].require(side["workflow"].text() == "metallic", "\"metallic\" on this side of the formula");
  return {read_model(side["model"]), side["dielectric_f0"].number(), read_diffuse(side), read_width(side)};
}

std::string fit_to_json(const WorkflowFit& fit) {
  require_valid(fit.conversion, fit.id);
  const WorkflowConversion& conversion = fit.conversion;
  const bool to_metallic = conversion.is_to_metallic();
  const Json specular = to_json(conversion.specular), metallic = to_json(conversion.metallic);
  Json json = {{"format", "remap-fit"},
               {"version", kFitFormatVersion},
               {"id", fit.id},
               {"source", to_metallic ? specular : metallic},
               {"target", to_metallic ? metallic : specular},
               {"mapping", to_json(conversion.formula)}};
  if (fit.training) json["training"] = to_json(*fit.training);
  json["remarks"] = fit.remarks;
  json["tool"] = "remapc " + fit.tool_version;
  return json.dump(2) + "\n";
}

WorkflowConversion read_conversion(const Field& fit) {
  WorkflowConversion conversion;
  conversion.formula = read_formula(fit["mapping"]);
  const bool to_metallic = conversion.is_to_metallic();
  conversion.specular = read_specular_workflow(fit[to_metallic ? "source" : "target"]);
  conversion.metallic = read_metallic_workflow(fit[to_metallic ? "target" : "source"]);
  require_valid(conversion, fit.context());
  return conversion;
}

WorkflowFit read_workflow_fit(const Field& root) {
  WorkflowFit fit;
  fit.id = read_id(root["id"]);
  fit.conversion = read_conversion(root);
  fit.remarks = root["remarks"].texts();
  if (is_learned(fit.conversion.formula)) fit.training = read_training(root["training"]);
  fit.tool_version = read_tool_version(root["tool"]);
  return fit;
}

}  // namespace remap
