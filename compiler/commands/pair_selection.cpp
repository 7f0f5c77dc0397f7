#include "commands/pair_selection.hpp"

#include "command_line/command.hpp"

namespace remapc {

void PairSelection::add_model_options(remap::Command& app) {
  app.option_group("Models");
  app.add_option("--source", source, "Model to convert from")->type_name("MODEL")->required();
  app.add_option("--target", target, "Model to convert to")->type_name("MODEL")->required();
}

void PairSelection::add_picture_options(remap::Command& app) {
  app.option_group("Pictures and how they are compared");
  app.add_option("--objective", objective,
                 "natural: light at 60 degrees, relative weights; paper: headlight, uniform weights")
      ->type_name("NAME")
      ->capture_default_str();
  app.add_option("--light", lights,
                 "Lights, comma-separated: headlight, or degrees from the camera (overrides --objective)")
      ->type_name("LIGHTS");
  app.add_option("--weighting", weighting, "uniform or relative (overrides --objective)")->type_name("NAME");
  app.add_option("--resolution", resolution, "Width and height in pixels")->capture_default_str();
  app.add_option("--pixel-samples", pixel_samples, "N x N samples per pixel; 1: the pixel center")
      ->capture_default_str();
}

void PairSelection::add_rare_options(remap::Command& app) {
  app.option_group(remap::kRareOptions);
  app.add_option("--distance", distance, "Distance of the lights, in sphere radii")->capture_default_str();
  app.add_flag("--no-irradiance-matching", keep_irradiance,
               "Do not correct for a constant factor between the lights of two renderers");
  roles.add_options(app);
}

void PairSelection::fill(PairOptions* options) const {
  options->source = source;
  options->target = target;
  options->source_roles = roles.source();
  options->target_roles = roles.target();
  options->objective = objective_preset(objective);
  options->objective_name = objective;
  const Objective preset = options->objective;
  if (!lights.empty()) options->objective.lights = parse_lights(lights, distance);
  for (Light& light : options->objective.lights) light.distance = distance;
  if (!weighting.empty()) options->objective.weighting = weighting_from_name(weighting);
  if (options->objective.lights != preset.lights || options->objective.weighting != preset.weighting)
    options->objective_name = "custom";
  options->resolution = resolution;
  options->samples_per_axis = pixel_samples;
  options->match_irradiance = !keep_irradiance;
}

}  // namespace remapc
