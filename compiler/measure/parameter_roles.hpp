// This file chooses which parameters of a model a sweep varies, and which values the other parameters keep. A
// principled material has more parameters than a sweep has roles. Base color, metallic or specular level can
// each have the role of specular.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "renderer/renderer.hpp"

namespace remap {

// A ParameterRoles assigns parameters to roles. An empty name keeps the model's parameter.
struct ParameterRoles {
  std::string roughness;
  std::optional<RoughnessEncoding> convention;  // encoding of `roughness`; if unset, the model's own
  std::string specular;
  std::string diffuse;
  std::map<std::string, double> fixed;  // values by name of the parameter
};

// Reads back the roles recorded in a table of remapc sweep, from its comments `<side>_roughness_parameter`,
// `<side>_specular` and `<side>_fixed`. An empty text means a missing comment.
ParameterRoles recorded_roles(const std::string& roughness, const std::string& specular,
                              const std::string& fixed);

// Returns `model` with the roles of `roles`. Fixed parameters, and parameters that lost their role, become
// kOther and keep one value. Throws kUsage, beginning with the model's name, for an unknown parameter, for a
// value out of range, and for a parameter that lost its role but has no value.
ModelDescription recast(const ModelDescription& model, const ParameterRoles& roles);

// Returns the parameters without a role as a table records them: `metallic=1,specular=0.5`.
std::string fixed_text(const ModelDescription& model);

}  // namespace remap
