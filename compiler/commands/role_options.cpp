#include "commands/role_options.hpp"

#include "command_line/command.hpp"
#include "commands/parameter_setting.hpp"
#include "remap/error.hpp"

namespace remapc {

void RoleOptions::add_options(remap::Command& app) {
  app.option_group("Rare: parameters of models (remapc list --models, remapc renderers)");
  source_.add_options(app, "source");
  target_.add_options(app, "target");
}

void RoleOptions::Side::add_options(remap::Command& app, const std::string& side) {
  const std::string prefix = "--" + side;
  app.add_option(prefix + "-roughness", roughness,
                 "Parameter of the " + side + " that is its roughness (default: as the model declares it)")
      ->type_name("NAME[:CONVENTION]");
  app.add_option(prefix + "-specular", specular, "Parameter that is its specular")->type_name("NAME");
  app.add_option(prefix + "-diffuse", diffuse, "Parameter that is its diffuse")->type_name("NAME");
  app.add_option(prefix + "-set", settings, "Fixed value of another parameter; may be repeated")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
}

ParameterRoles RoleOptions::Side::roles(const std::string& prefix) const {
  ParameterRoles roles;
  if (!roughness.empty()) cast_roughness(roughness, &roles);
  roles.specular = specular;
  roles.diffuse = diffuse;
  for (const std::string& text : settings) {
    const ParameterSetting setting = parse_setting(prefix + "-set", text);
    if (setting.values.size() != 1)
      throw remap::Error(remap::ErrorKind::kUsage, prefix + "-set " + text + ": " +
                                                       std::to_string(setting.values.size()) +
                                                       " values given (give one: sweeps are grey)");
    roles.fixed[setting.name] = setting.values[0];
  }
  return roles;
}

}  // namespace remapc
