// The options that choose the two models of a sweep and how their pictures are rendered and compared.
#pragma once

#include <string>

#include "commands/role_options.hpp"
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

  // Add the options to `app`: the models; how pictures are made and compared; the rare ones.
  void add_model_options(remap::Command& app);
  void add_picture_options(remap::Command& app);
  void add_rare_options(remap::Command& app);
  // Copies the choices to `options`. Throws kUsage for an unknown objective, weighting or light.
  void fill(PairOptions* options) const;
};

}  // namespace remapc
