// This file reads and writes fits between workflows as JSON.
#include "lower/fit_fields.hpp"
#include "lower/fit_file.hpp"

namespace remap {
namespace {

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
