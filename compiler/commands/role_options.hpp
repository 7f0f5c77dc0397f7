// The options that choose which parameters of two models are roughness, specular and diffuse.
#pragma once

#include <string>
#include <vector>

#include "command_line/command.hpp"
#include "probe/parameter_roles.hpp"

namespace remapc {

class RoleOptions {
 public:
  void add_options(remap::Command& app);

  // Throw kUsage for a setting that cannot be read or has more than one value.
  ParameterRoles source() const { return source_.roles("--source"); }
  ParameterRoles target() const { return target_.roles("--target"); }

 private:
  struct Side {
    std::string roughness, specular, diffuse;
    std::vector<std::string> settings;

    void add_options(remap::Command& app, const std::string& side);
    ParameterRoles roles(const std::string& prefix) const;
  };

  Side source_, target_;
};

}  // namespace remapc
