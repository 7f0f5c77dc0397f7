// The options by which a command takes the roles of two models.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "probe/parameter_roles.hpp"

namespace remapc {

class RoleOptions {
 public:
  void add_options(CLI::App& app);

  // Throw kUsage.
  ParameterRoles source() const { return source_.roles("--source"); }
  ParameterRoles target() const { return target_.roles("--target"); }

 private:
  struct Side {
    std::string roughness, specular, diffuse;
    std::vector<std::string> settings;

    void add_options(CLI::App& app, const std::string& prefix);
    ParameterRoles roles(const std::string& prefix) const;
  };

  Side source_, target_;
};

}  // namespace remapc
