// `remapc preview` compares a source with its conversion, as pictures and figures.
#include "report/preview.hpp"

#include <iomanip>
#include <iostream>

#include "build/fit_folder.hpp"
#include "command_line/interruption.hpp"
#include "commands/commands.hpp"
#include "commands/option_readers.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json.hpp"
#include "core/number_text.hpp"
#include "renderer/image_file.hpp"
#include "worker/renderer_options.hpp"

namespace remap {
namespace {

struct PreviewCommand {
  std::string fit;
  std::filesystem::path fit_folder, output;
  PreviewOptions options;
  bool bare = false, force = false, json = false;
  RendererOptions renderers;
  std::string environment;  // empty: one light
  double exposure = 1.0;
  LitPreviewOptions lit;  // takes alphas, specular, resolution and samples from `options`
};

Json material_json(const auto& figure) {
  return {{"alpha", figure.alpha},
          {"target_alpha", figure.target_alpha},
          {"target_specular", figure.target_specular},
          {"in_domain", figure.in_domain}};
}

Json similarity_json(const auto& figure) { return {{"ssim", figure.ssim}, {"rms", figure.rms}}; }

Json figure_json(const PreviewFigure& figure) {
  Json json = {{"shape", shape_name(figure.shape)}};
  json.update(material_json(figure));
  json.update(similarity_json(figure));
  return json;
}

Json figure_json(const LitFigure& figure) {
  Json json = material_json(figure);
  json["copied"] = similarity_json(figure.copied);
  json["converted"] = similarity_json(figure.converted);
  return json;
}

void print_figures(const std::vector<PreviewFigure>& figures) {
  std::cout << "shape    alpha   -> alpha   SSIM    RMS, % of the display's range\n";
  for (const PreviewFigure& figure : figures)
    std::cout << std::left << std::setw(9) << shape_name(figure.shape) << std::setw(8) << std::defaultfloat
              << std::setprecision(3) << figure.alpha << std::fixed << std::setprecision(4) << std::setw(11)
              << figure.target_alpha << std::setw(8) << figure.ssim << std::setprecision(2)
              << 100.0 * figure.rms << (figure.in_domain ? "" : "   outside the domain") << "\n";
}

void print_figures(const std::vector<LitFigure>& figures) {
  std::cout << "alpha   -> alpha   copied: SSIM  RMS %   converted: SSIM  RMS %\n";
  for (const LitFigure& figure : figures)
    std::cout << std::left << std::defaultfloat << std::setprecision(3) << std::setw(8) << figure.alpha
              << std::fixed << std::setprecision(4) << std::setw(11) << figure.target_alpha << std::setw(14)
              << figure.copied.ssim << std::setprecision(2) << std::setw(8) << 100.0 * figure.copied.rms
              << std::setprecision(4) << std::setw(17) << figure.converted.ssim << std::setprecision(2)
              << 100.0 * figure.converted.rms << (figure.in_domain ? "" : "   outside the domain") << "\n";
}

// Writes and prints a preview of either kind.
void report(const PreviewCommand& command, const Fit& fit, const auto& preview) {
  if (!command.output.empty())
    write_png(command.output, command.bare ? preview.sheet : labelled(preview.sheet, preview.labels));
  if (!command.json) {
    std::cout << fit.source.model << " -> " << fit.target.model
              << (command.environment.empty() ? "" : " under " + command.environment) << ", specular";
    for (const double value : preview.specular) std::cout << " " << number_text(value);
    std::cout << "\n";
    return print_figures(preview.figures);
  }
  Json json = {{"fit", fit.id}, {"source", fit.source.model}, {"target", fit.target.model}};
  if (!command.environment.empty()) json["environment"] = command.environment;
  json["specular"] = preview.specular;
  json["figures"] = Json::list();
  for (const auto& figure : preview.figures) json["figures"].push_back(figure_json(figure));
  if (!command.output.empty()) json["picture"] = command.output.string();
  std::cout << json.dump(2) << "\n";
}

// Under an environment: the source, copied numbers, converted numbers.
void run_lit(const PreviewCommand& command, const Fit& fit) {
  const Environment environment = environment_for_preview(command.environment, command.exposure);
  LitPreviewOptions options = command.lit;
  options.alphas = command.options.alphas;
  options.specular = command.options.specular;
  options.resolution = command.options.resolution;
  options.samples_per_axis = command.options.samples_per_axis;
  report(command, fit, make_lit_preview(fit, environment, options));
}

void run(const PreviewCommand& command) {
  watch_interruptions();
  require_new(command.output, command.force);
  if (!command.environment.empty()) return run_lit(command, find_fit(command.fit, command.fit_folder));
  const Fit fit = find_fit(command.fit, command.fit_folder);
  report(command, fit, make_preview(*make_renderers(command.renderers), fit, command.options));
}

void add_environment_options(Command& command, PreviewCommand& options) {
  command.option_group("Environment");
  command
      .add_option("--environment NAME or FILE", options.environment,
                  "Light spheres by sky, overcast, studio, or a map (EXR, HDR) instead of one light; one row "
                  "per alpha: source, numbers copied, numbers converted")
      ->excludes(command.option("--light"))
      ->excludes(command.option("--shape"));
  command.add_option("--exposure", options.exposure, "Mean luminance of the environment");
  command.add_option("--diffuse", options.lit.diffuse, "Diffuse reflectance of all spheres, 0 to 1");
  command.add_option("--directions", options.lit.directions, "Light directions per sample of a pixel")
      ->range(16, 65536);
}

void require_environment(const Command& command, const PreviewCommand& options) {
  for (const char* option : {"--exposure", "--diffuse", "--directions"})
    if (options.environment.empty() && command.count(option) > 0)
      throw usage_error(std::string(option) + " needs --environment");
}

}  // namespace

void add_preview_command(Command& app) {
  Command* command = app.add_subcommand(
      "preview", "Render a source model and its conversion side by side, and print their similarity",
      kLookStage);
  PreviewCommand& options = set_work<PreviewCommand>(*command, [command](const PreviewCommand& given) {
    require_environment(*command, given);
    run(given);
  });
  command->add_option("fit", options.fit, "Fit: file, or id in the folder of fits")->required();
  command->option_group("Input");
  add_fits_option(*command, options.fit_folder, "Folder where ids are looked up");
  command->option_group("Output");
  command->add_option(
      "-o,--output FILE", options.output,
      "PNG to write: a column per alpha; source, conversion, and their difference times four");
  command->add_flag("--no-labels", options.bare, "Write the pictures alone, without names and numbers");
  add_force_flag(*command, options.force);
  command->add_flag("--json", options.json, "Print the figures as JSON to standard output");
  command->option_group("Materials and pictures");
  command
      ->add_option("--alpha ALPHA,...", options.options.alphas,
                   "Alphas of the source, comma-separated (default: four values of the fit's domain)")
      ->delimiter(',');
  command
      ->add_option("--specular VALUE or R,G,B", options.options.specular,
                   "Specular of the source (default: half the maximum of the fit's domain)")
      ->delimiter(',');
  command
      ->add_option("--shape SHAPE,...", options.options.shapes, list_of(one_of(kShapes, "shape")),
                   "Shapes, comma-separated")
      ->default_text("sphere,torus");
  command
      ->add_option("--light LIGHT", options.options.light.angle, light_angle(),
                   "Light: headlight, or degrees from the camera")
      ->default_text("45");
  command->add_option("--resolution", options.options.resolution, "Width and height of each picture")
      ->range(16, 2048);
  add_environment_options(*command, options);
  command->option_group(kRareOptions);
  command->add_option("--distance", options.options.light.distance, "Distance of the light, in sphere radii");
  command
      ->add_option("--pixel-samples", options.options.samples_per_axis,
                   "N x N samples per pixel; 1: the pixel center")
      ->range(1, 16);
  add_renderer_options(*command, options.renderers);
  command->footer(
      "Example:\n"
      "  remapc preview mitsuba_ward_to_mitsuba_ggx --specular 0.4,0.3,0.1 \\\n"
      "    -o preview.png\n"
      "  remapc preview mitsuba_ward_to_mitsuba_as --environment studio \\\n"
      "    -o preview.png");
}

}  // namespace remap
