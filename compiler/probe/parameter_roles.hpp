// Which of a model's parameters a sweep turns, and what the others are held at. A principled material has
// more parameters than a sweep has roles: base color, metallic, roughness and specular level may each be the
// one.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "renderer/renderer.hpp"

namespace remapc {

// Empty names: the parameters that the model itself gives the roles to.
struct ParameterRoles {
  std::string roughness;
  std::optional<remap::RoughnessConvention> convention;  // of `roughness`; none: that of the model
  std::string specular;
  std::string diffuse;
  std::map<std::string, double> fixed;  // by name
};

// `NAME` or `NAME:CONVENTION`, as a command line gives the roughness of a roles. Throws kUsage.
void cast_roughness(const std::string& text, ParameterRoles* roles);

// The roles that a table of remapc sweep records: the values of its comments `<side>_roughness_parameter`,
// `<side>_specular` and `<side>_fixed`; empty where it has none.
ParameterRoles recorded_roles(const std::string& roughness, const std::string& specular,
                              const std::string& fixed);

// The model with its roles given as the roles says: parameters that are fixed, and those that have lost
// their role, are of no role and stay at a value. Throws kUsage, in words that begin with the model's name,
// for parameters that it has not, values out of range, and a parameter that lost its role without a value.
ModelDescription recast(const ModelDescription& model, const ParameterRoles& roles);

// What a table says of parameters of no role: `metallic=1,specular=0.5`; empty where there are none.
std::string fixed_text(const ModelDescription& model);

}  // namespace remapc
