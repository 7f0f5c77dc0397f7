#include "sweep/renderer.hpp"

#include "error.hpp"
#include "nearest_name.hpp"

namespace remapc {

const ParameterDescription& ModelDescription::parameter(ParameterRole role) const {
  for (const ParameterDescription& description : parameters)
    if (description.role == role) return description;
  throw remap::Error(remap::ErrorKind::kUsage, name + ": has no parameter of the role that was asked for");
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
