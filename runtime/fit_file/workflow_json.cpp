// Analytic fits as JSON.
#include <cmath>

#include "fit_file/workflow_fields.hpp"
#include "remap/error.hpp"
#include "remap/fit_file.hpp"
#include "system/files.hpp"

namespace remap {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const SpecularWorkflow& workflow) {
  return {{"model", workflow.model},
          {"workflow", "specular"},
          {"diffuse", std::string(diffuse_convention_name(workflow.diffuse))},
          {"roughness", std::string(convention_name(workflow.width))}};
}

Json to_json(const MetallicWorkflow& workflow) {
  return {{"model", workflow.model},
          {"workflow", "metallic"},
          {"dielectric_f0", workflow.dielectric_f0},
          {"diffuse", std::string(diffuse_convention_name(workflow.diffuse))},
          {"roughness", std::string(convention_name(workflow.width))}};
}

Json to_json(const WorkflowFormula& formula) {
  if (const auto* learned = std::get_if<LearnedNetwork>(&formula))
    return {{"kind", "mlp"}, {"network", network_json(learned->network)}};
  Json json = {{"kind", kWorkflowKind}, {"formula", std::string(formula_name(formula))}};
  if (const auto* projection = std::get_if<Projection>(&formula)) json["prior"] = projection->prior;
  if (const auto* equation = std::get_if<Equation3>(&formula))
    json["mean"] = std::string(metallic_mean_name(equation->mean));
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
  training.method = field["method"].dictionary<std::string>([](const Field& entry) { return entry.text(); });
  training.base_color = read_figures(field["error_on_held_out_rows"]["base_color"]);
  training.metallic = read_figures(field["error_on_held_out_rows"]["metallic"]);
  training.split = read_split(field["split"]);
  training.table = read_table_record(field["table"]);
  return training;
}

WorkflowFit read_workflow(const Field& root) {
  WorkflowFit fit;
  fit.id = read_id(root["id"]);
  fit.conversion = read_conversion(root);
  fit.remarks = read_texts(root["remarks"]);
  if (is_learned(fit.conversion.formula)) fit.training = read_training(root["training"]);
  fit.tool_version = read_tool_version(root["tool"]);
  return fit;
}

}  // namespace

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

AnyFit any_fit_from_json(std::string_view text, const std::string& place) {
  const Json json = parse_json(text, place);
  const Field root(json, place);
  require_fit_format(root);
  if (is_of_materials(root) && root["mapping"]["kind"].text() == kWarpKind) return read_warp_fit(root);
  if (is_of_materials(root)) return read_workflow(root);
  return read_fit(root);
}

AnyFit load_any_fit(const std::filesystem::path& path) {
  return any_fit_from_json(read_file(path), path.string());
}

const Fit& require_width_and_specular(const AnyFit& fit, ErrorKind kind, const std::string& place) {
  if (const Fit* found = std::get_if<Fit>(&fit)) return *found;
  throw Error(kind, place +
                        ": converts whole materials, but this needs a fit of roughness and specular "
                        "(fits of materials can be listed, shown and emitted)");
}

}  // namespace remap
