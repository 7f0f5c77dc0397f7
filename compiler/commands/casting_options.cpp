#include "commands/casting_options.hpp"

#include "commands/parameter_setting.hpp"
#include "remap/error.hpp"

namespace remapc {

void RoleOptions::add_options(CLI::App& app) {
  source_.add_options(app, "--source");
  target_.add_options(app, "--target");
}

void RoleOptions::Side::add_options(CLI::App& app, const std::string& prefix) {
  const std::string group = "Models with more parameters (remapc list --models, remapc renderers)";
  app.add_option(prefix + "-roughness", roughness,
                 "NAME or NAME:CONVENTION: the parameter that is the roughness; default: the model's own")
      ->group(group);
  app.add_option(prefix + "-specular", specular, "NAME: the parameter that is the specular")->group(group);
  app.add_option(prefix + "-diffuse", diffuse, "NAME: the parameter that is the diffuse")->group(group);
  app.add_option(prefix + "-set", settings, "NAME=VALUE: a parameter that stays at a value")
      ->allow_extra_args(false)
      ->group(group);
}

ParameterRoles RoleOptions::Side::roles(const std::string& prefix) const {
  ParameterRoles roles;
  if (!roughness.empty()) cast_roughness(roughness, &roles);
  roles.specular = specular;
  roles.diffuse = diffuse;
  for (const std::string& text : settings) {
    const ParameterSetting setting = parse_setting(prefix + "-set", text);
    if (setting.values.size() != 1)
      throw remap::Error(remap::ErrorKind::kUsage, prefix + "-set " + text + ": has " +
                                                       std::to_string(setting.values.size()) +
                                                       " values; expected one, as sweeps are of grey");
    roles.fixed[setting.name] = setting.values[0];
  }
  return roles;
}

}  // namespace remapc
