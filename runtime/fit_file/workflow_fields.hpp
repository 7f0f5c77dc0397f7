// Fields of analytic fits, which fit files and manifests share.
#pragma once

#include "fit_file/fit_fields.hpp"
#include "fit_file/network_json.hpp"
#include "remap/workflow_fit.hpp"

namespace remap {

inline DiffuseConvention read_diffuse(const Field& field) {
  const auto convention = diffuse_convention_from_name(field.text());
  field.require(convention.has_value(), "plain or scaled");
  return *convention;
}

inline RoughnessConvention read_width(const Field& field) {
  const auto convention = convention_from_name(field.text());
  field.require(convention.has_value(), "roughness, glossiness or alpha");
  return *convention;
}

inline std::string read_model(const Field& field) {
  const std::string model = field.text();
  field.require(is_valid_model(model), "letters, digits and _ - . /");
  return model;
}

inline SpecularWorkflow read_specular_workflow(const Field& side) {
  side["workflow"].require(side["workflow"].text() == "specular", "\"specular\" on this side of the formula");
  return {read_model(side["model"]), read_diffuse(side["diffuse"]), read_width(side["roughness"])};
}

inline MetallicWorkflow read_metallic_workflow(const Field& side) {
  side["workflow"].require(side["workflow"].text() == "metallic", "\"metallic\" on this side of the formula");
  return {read_model(side["model"]), side["dielectric_f0"].number(), read_diffuse(side["diffuse"]),
          read_width(side["roughness"])};
}

inline WorkflowFormula read_formula(const Field& mapping) {
  if (mapping["kind"].text() == "mlp") return LearnedNetwork{read_network(mapping["network"], 4)};
  mapping["kind"].require(mapping["kind"].text() == kWorkflowKind, "analytic or mlp");
  const std::string name = mapping["formula"].text();
  if (name == "equation-2") return Equation2{};
  if (name == "projection") return Projection{mapping["prior"].number()};
  if (name == "khronos") return KhronosSolver{};
  mapping["formula"].require(name == "equation-3", "equation-2, projection, equation-3 or khronos");
  const auto mean = metallic_mean_from_name(mapping["mean"].text());
  mapping["mean"].require(mean.has_value(), "plain or albedo");
  return Equation3{*mean};
}

// The fields `source`, `target` and `mapping` of a fit. Throws kInput, for conversions that require_valid()
// refuses too.
inline WorkflowConversion read_conversion(const Field& fit) {
  WorkflowConversion conversion;
  conversion.formula = read_formula(fit["mapping"]);
  const bool to_metallic = conversion.is_to_metallic();
  conversion.specular = read_specular_workflow(fit[to_metallic ? "source" : "target"]);
  conversion.metallic = read_metallic_workflow(fit[to_metallic ? "target" : "source"]);
  require_valid(conversion, fit.place());
  return conversion;
}

}  // namespace remap
