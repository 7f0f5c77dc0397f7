// The options by which a command takes the castings of two models.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "sweep/casting.hpp"

namespace remapc {

class CastingOptions {
 public:
  void add_options(CLI::App& app);

  // Throw kUsage.
  Casting source() const { return source_.casting("--source"); }
  Casting target() const { return target_.casting("--target"); }

 private:
  struct Side {
    std::string roughness, specular, diffuse;
    std::vector<std::string> settings;

    void add_options(CLI::App& app, const std::string& prefix);
    Casting casting(const std::string& prefix) const;
  };

  Side source_, target_;
};

}  // namespace remapc
