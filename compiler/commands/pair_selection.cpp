#include "commands/pair_selection.hpp"

namespace remapc {

void PairSelection::add_options(CLI::App& app) {
  app.add_option("--source", source, "Model to convert from")->required();
  app.add_option("--target", target, "Model to convert to")->required();
  app.add_option("--objective", objective,
                 "natural: light at 60 degrees, relative weights; paper: headlight, uniform weights")
      ->capture_default_str();
  app.add_option("--light", lights, "Instead of the objective's: headlight or degrees, comma-separated");
  app.add_option("--distance", distance, "Of the lights, in sphere radii")->capture_default_str();
  app.add_option("--weighting", weighting, "Instead of the objective's: uniform or relative");
  app.add_option("--resolution", resolution, "Width and height of the pictures")->capture_default_str();
  app.add_option("--pixel-samples", pixel_samples, "N x N samples in each pixel; 1: its centre")
      ->capture_default_str();
  app.add_flag("--no-irradiance-matching", keep_irradiance,
               "Leave a factor between the light of two renderers in specular and diffuse");
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
