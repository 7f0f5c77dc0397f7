#include "sweep/renderer.hpp"

#include <algorithm>

#include "error.hpp"
#include "nearest_name.hpp"

namespace remapc {

namespace {

const char* role_name(ParameterRole role) {
  switch (role) {
    case ParameterRole::kRoughness:
      return "roughness";
    case ParameterRole::kSpecular:
      return "specular";
    case ParameterRole::kDiffuse:
      return "diffuse";
    case ParameterRole::kIndex:
      return "index of refraction";
    case ParameterRole::kExtinction:
      return "extinction";
  }
  return "";
}

}  // namespace

bool ModelDescription::has(ParameterRole role) const {
  return std::any_of(parameters.begin(), parameters.end(),
                     [&](const ParameterDescription& description) { return description.role == role; });
}

const ParameterDescription& ModelDescription::parameter(ParameterRole role) const {
  for (const ParameterDescription& description : parameters)
    if (description.role == role) return description;
  throw remap::Error(remap::ErrorKind::kUsage, name + ": has no parameter for " + role_name(role) +
                                                   "; expected a model with one (remapc list --models)");
}

ModelDescription find_model(const Renderer& renderer, const std::string& name) {
  std::vector<std::string> names;
  for (const ModelDescription& model : renderer.models()) {
    if (model.name == name) return model;
    names.push_back(model.name);
  }
  throw remap::Error(remap::ErrorKind::kUsage,
                     name + ": is no model of " + renderer.version() + remap::suggestion(name, names));
}

Material grey_material(const ModelDescription& model, double alpha, double specular, double diffuse) {
  return {model.name,
          {{model.parameter(ParameterRole::kRoughness).name, {remap::from_alpha(model.roughness, alpha)}},
           {model.parameter(ParameterRole::kSpecular).name, {specular}},
           {model.parameter(ParameterRole::kDiffuse).name, {diffuse}}}};
}

remap::ModelSide model_side(const ModelDescription& model) {
  return {model.name, model.roughness, model.parameter(ParameterRole::kSpecular).name};
}

}  // namespace remapc
