// This file is `remapc render`, which renders one picture of the sweep scene.
#include "commands/commands.hpp"
#include "commands/option_readers.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/number_text.hpp"
#include "look/image.hpp"
#include "renderer/renderer.hpp"
#include "worker/renderer_set.hpp"

namespace remap {
namespace {

struct RenderOptions {
  std::string model;
  std::map<std::string, std::vector<double>> settings;
  Scene scene;
  std::string output;
  bool force = false;
  RendererOptions renderers;
};

Material material_of(const ModelDescription& model,
                     const std::map<std::string, std::vector<double>>& settings) {
  Material material{model.name, settings};
  for (const ParameterDescription& parameter : model.parameters) {
    if (material.parameters.contains(parameter.name)) continue;
    const bool has_standard =
        parameter.role == ParameterRole::kDiffuse || parameter.role == ParameterRole::kOther;
    if (!has_standard)
      throw usage_error(model.name + ": parameter " + parameter.name + " is required (add --set " +
                        parameter.name + "=VALUE)");
    material.parameters[parameter.name] = {parameter.standard};
  }
  return material;
}

void run(const RenderOptions& options) {
  require_new(options.output, options.force);
  const auto renderer = make_renderers(options.renderers);
  const ModelDescription model = renderer->model(options.model);
  const Material material = material_of(model, options.settings);
  const Image image = renderer->render(material, options.scene);

  std::map<std::string, std::string> attributes = {{"remap:renderer", renderer->version_of(model.name)},
                                                   {"remap:model", model.name},
                                                   {"remap:light", light_name(options.scene.light)}};
  for (const auto& [name, values] : material.parameters) {
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : ",") + number_text(value);
    attributes["remap:" + name] = text;
  }
  write_exr(options.output, image, attributes);
}

}  // namespace

void add_render_command(Command& app) {
  Command* command = app.add_subcommand(
      "render", "Render one picture of the sweep scene: a sphere under a point light", kMeasureStage);
  RenderOptions& options = set_work<RenderOptions>(*command, run);
  command->option_group("Material");
  command
      ->add_option("--model MODEL", options.model,
                   "Model, as mitsuba/ward; remapc list --models and remapc renderers list them")
      ->required();
  add_settings<std::vector<double>>(
      *command, "--set NAME=VALUE or NAME=R,G,B", options.settings,
      [](const ParameterSetting& setting) { return setting.values; },
      "Parameter of the model; may be repeated");
  command->option_group("Output");
  command->add_option("-o,--output FILE", options.output, "EXR file to write, linear float")->required();
  add_force_flag(*command, options.force);
  command->option_group("Picture");
  command
      ->add_option("--light LIGHT", options.scene.light.angle, light_angle(),
                   "Light: headlight, or degrees from the camera")
      ->default_text("headlight");
  command->add_option("--resolution", options.scene.resolution, "Width and height in pixels");
  command->add_option("--pixel-samples", options.scene.samples_per_axis,
                      "N x N samples per pixel; 1: the pixel center");
  command->option_group(kRareOptions);
  command->add_option("--distance", options.scene.light.distance, "Distance of the light, in sphere radii");
  command->add_option("--seed", options.scene.seed, "Seed of renderers with noise");
  add_renderer_options(*command, options.renderers);
  command->footer(
      "Example:\n"
      "  remapc render --model mitsuba/ward --set alpha=0.2 \\\n"
      "    --set specular=0.9,0.6,0.2 --light 45 -o sphere.exr");
}

}  // namespace remap
