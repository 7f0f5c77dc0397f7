// The options by which a command takes the pair of models of a sweep and how their pictures are compared.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "commands/casting_options.hpp"
#include "sweep/sweep.hpp"

namespace remapc {

struct PairSelection {
  std::string source, target;
  std::string objective = "natural";
  std::string lights, weighting;  // empty: as the objective has them
  double distance = 3.0;
  int resolution = 512;
  int pixel_samples = 1;
  bool keep_irradiance = false;
  RoleOptions roles;

  void add_options(CLI::App& app);
  // Throws kUsage.
  void fill(PairOptions* options) const;
};

}  // namespace remapc
