// `remapc render`: one picture of the sweep scene.
#include <memory>

#include "commands/commands.hpp"
#include "commands/parameter_setting.hpp"
#include "commands/renderer_options.hpp"
#include "probe/objective.hpp"
#include "remap/error.hpp"
#include "renderer/image_file.hpp"
#include "renderer/renderer.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

struct RenderOptions {
  std::string model;
  std::vector<std::string> settings;  // NAME=VALUE or NAME=R,G,B
  std::string light = "headlight";
  double distance = 3.0;
  int resolution = 512;
  int pixel_samples = 1;
  int seed = 0;
  std::string output;
  RendererOptions renderers;
};

Material parse_material(const ModelDescription& model, const std::vector<std::string>& settings) {
  Material material{model.name, {}};
  for (const std::string& text : settings) {
    const ParameterSetting setting = parse_setting("--set", text);
    material.parameters[setting.name] = setting.values;
  }
  for (const ParameterDescription& parameter : model.parameters) {
    if (material.parameters.contains(parameter.name)) continue;
    const bool has_standard =
        parameter.role == ParameterRole::kDiffuse || parameter.role == ParameterRole::kOther;
    if (!has_standard)
      throw Error(ErrorKind::kUsage, model.name + ": needs --set " + parameter.name + "=VALUE");
    material.parameters[parameter.name] = {parameter.standard};
  }
  return material;
}

void run(const RenderOptions& options) {
  const auto renderer = make_renderers(options.renderers);
  const ModelDescription model = find_model(*renderer, options.model);
  const Material material = parse_material(model, options.settings);
  const std::vector<Light> lights = parse_lights(options.light, options.distance);
  if (lights.size() != 1) throw Error(ErrorKind::kUsage, "--light: one picture has one light");
  const Scene scene{options.resolution, options.pixel_samples, lights.front(), options.seed};
  const Image image = renderer->render(material, scene);

  std::map<std::string, std::string> attributes = {{"remap:renderer", renderer->version_of(model.name)},
                                                   {"remap:model", model.name},
                                                   {"remap:light", light_name(lights.front())}};
  for (const auto& [name, values] : material.parameters) {
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : ",") + remap::number_text(value);
    attributes["remap:" + name] = text;
  }
  write_exr(options.output, image, attributes);
}

}  // namespace

void add_render_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("render", "Render one picture of the sweep scene: a sphere and a point light");
  auto options = std::make_shared<RenderOptions>();
  command
      ->add_option("--model", options->model,
                   "Model, e.g. mitsuba/ward (remapc list --models, remapc renderers)")
      ->required();
  command->add_option("--set", options->settings, "Parameter of the model: NAME=VALUE or NAME=R,G,B")
      ->allow_extra_args(false);
  command->add_option("--light", options->light, "headlight, or degrees from the camera")
      ->capture_default_str();
  command->add_option("--distance", options->distance, "Of the light, in sphere radii")
      ->capture_default_str();
  command->add_option("--resolution", options->resolution, "Width and height in pixels")
      ->capture_default_str();
  command->add_option("--pixel-samples", options->pixel_samples, "N x N samples in each pixel; 1: its centre")
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of renderers with noise")->capture_default_str();
  add_renderer_options(*command, options->renderers);
  command->add_option("-o,--output", options->output, "EXR file to write, linear float")->required();
  command->footer(
      "Example:\n  remapc render --model mitsuba/ward --set alpha=0.2 --set specular=0.9,0.6,0.2 "
      "--light 45 -o sphere.exr");
  command->callback([options] { run(*options); });
}

}  // namespace remapc
