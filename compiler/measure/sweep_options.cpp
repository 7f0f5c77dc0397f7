#include "measure/sweep_options.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "core/errors.hpp"
#include "core/number_text.hpp"

namespace remap {
namespace {

ParameterDescription& named(ModelDescription* model, const std::string& name) {
  const ParameterDescription& found = std::as_const(*model).parameter(name);
  return model->parameters[static_cast<std::size_t>(&found - model->parameters.data())];
}

// Gives `role` to the parameter `name`. The parameter that had this role becomes kOther and is added to
// `displaced`.
void give_role(ModelDescription* model, ParameterRole role, const std::string& name,
               std::set<std::string>* displaced) {
  if (name.empty()) return;
  ParameterDescription& chosen = named(model, name);
  for (ParameterDescription& parameter : model->parameters) {
    if (parameter.role != role || parameter.name == name) continue;
    parameter.role = ParameterRole::kOther;
    displaced->insert(parameter.name);
  }
  chosen.role = role;
  displaced->erase(name);
}

void fix(ModelDescription* model, const std::string& name, double value, std::set<std::string>* displaced) {
  ParameterDescription& parameter = named(model, name);
  if (parameter.role == ParameterRole::kRoughness || parameter.role == ParameterRole::kSpecular)
    throw usage_error(model->name + ": " + name + " is the " + std::string(role_word(parameter.role)) +
                      " of this sweep and cannot be fixed (fix another parameter)");
  require_value(*model, parameter, value);
  parameter.role = ParameterRole::kOther;
  parameter.standard = value;
  displaced->erase(name);
}

// Recomputes the range of alpha after the roughness parameter or its convention changed.
void measure_widths(ModelDescription* model) {
  const ParameterDescription& roughness = model->parameter(ParameterRole::kRoughness);
  const Range alphas = canonical_widths(model->roughness, roughness.range);
  if (!(alphas.min >= 0.0) || !(alphas.max > 0.0))
    throw usage_error(model->name + ": the range of " + roughness.name + " is invalid for the convention " +
                      std::string(encoding_name(model->roughness)) +
                      " (choose another convention: " + roughness.name + ":CONVENTION)");
  model->alpha = alphas;
}

}  // namespace

ParameterRoles recorded_roles(const std::string& roughness, const std::string& specular,
                              const std::string& fixed) {
  ParameterRoles roles;
  roles.roughness = roughness;
  roles.specular = specular;
  std::string_view left = fixed;
  while (!left.empty()) {
    const std::string_view setting = left.substr(0, left.find(','));
    left.remove_prefix(std::min(left.size(), setting.size() + 1));
    const std::size_t equals = setting.find('=');
    const auto value =
        equals == std::string_view::npos ? std::nullopt : parse_number(setting.substr(equals + 1));
    if (!value)
      throw input_error("fixed parameters: cannot read \"" + fixed + "\" (use NAME=VALUE,NAME=VALUE)");
    roles.fixed[std::string(setting.substr(0, equals))] = *value;
  }
  return roles;
}

ModelDescription recast(const ModelDescription& model, const ParameterRoles& roles) {
  ModelDescription result = model;
  std::set<std::string> displaced;
  give_role(&result, ParameterRole::kRoughness, roles.roughness, &displaced);
  give_role(&result, ParameterRole::kSpecular, roles.specular, &displaced);
  give_role(&result, ParameterRole::kDiffuse, roles.diffuse, &displaced);
  if (roles.convention) result.roughness = *roles.convention;
  for (const auto& [name, value] : roles.fixed) fix(&result, name, value, &displaced);
  if (!displaced.empty())
    throw usage_error(model.name + ": " + *displaced.begin() +
                      " no longer has a role and needs a value (add " + *displaced.begin() +
                      "=VALUE to the fixed parameters)");
  for (const ParameterRole role : {ParameterRole::kRoughness, ParameterRole::kSpecular})
    if (model.has(role)) result.parameter(role);  // throws if the parameter has another role already
  if (!roles.roughness.empty() || roles.convention) measure_widths(&result);
  return result;
}

std::string fixed_text(const ModelDescription& model) {
  std::string text;
  for (const ParameterDescription& parameter : model.parameters)
    if (parameter.role == ParameterRole::kOther)
      text += (text.empty() ? "" : ",") + parameter.name + "=" + number_text(parameter.standard);
  return text;
}

}  // namespace remap
