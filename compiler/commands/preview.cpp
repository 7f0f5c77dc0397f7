// `remapc preview` compares a source with its conversion, as pictures and figures.
#include "report/preview.hpp"

#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>

#include "command_line/command.hpp"
#include "command_line/interruption.hpp"
#include "commands/commands.hpp"
#include "commands/renderer_options.hpp"
#include "manifest/fit_folder.hpp"
#include "probe/objective.hpp"
#include "remap/error.hpp"
#include "renderer/image_file.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

struct PreviewCommand {
  std::string fit;
  std::filesystem::path fit_folder = "fits", output;
  std::vector<double> alphas, specular;
  std::vector<std::string> shapes = {"sphere", "torus"};
  std::string light = "45";
  double distance = 3.0;
  int resolution = 256, pixel_samples = 2;
  bool json = false;
  RendererOptions renderers;
  std::string environment;  // empty: one light
  double exposure = 1.0, diffuse = 0.0;
  int directions = 512;
};

PreviewOptions preview_options(const PreviewCommand& command) {
  PreviewOptions options;
  options.alphas = command.alphas;
  options.specular = command.specular;
  options.shapes.clear();
  for (const std::string& name : command.shapes) options.shapes.push_back(shape_from_name(name));
  const std::vector<Light> lights = parse_lights(command.light, command.distance);
  if (lights.size() != 1)
    throw remap::Error(remap::ErrorKind::kUsage,
                       "--light: " + std::to_string(lights.size()) + " lights given (give one)");
  options.light = lights.front();
  options.resolution = command.resolution;
  options.samples_per_axis = command.pixel_samples;
  return options;
}

void print_json(const PreviewCommand& command, const remap::Fit& fit, const Preview& preview) {
  nlohmann::ordered_json figures = nlohmann::ordered_json::array();
  for (const PreviewFigure& figure : preview.figures)
    figures.push_back({{"shape", shape_name(figure.shape)},
                       {"alpha", figure.alpha},
                       {"target_alpha", figure.target_alpha},
                       {"target_specular", figure.target_specular},
                       {"in_domain", figure.in_domain},
                       {"ssim", figure.ssim},
                       {"rms", figure.rms}});
  nlohmann::ordered_json json = {{"fit", fit.id},
                                 {"source", fit.source.model},
                                 {"target", fit.target.model},
                                 {"specular", preview.specular},
                                 {"figures", figures}};
  if (!command.output.empty()) json["picture"] = command.output.string();
  std::cout << json.dump(2) << "\n";
}

void print_text(const remap::Fit& fit, const Preview& preview) {
  std::cout << fit.source.model << " -> " << fit.target.model << ", specular";
  for (const double value : preview.specular) std::cout << " " << remap::number_text(value);
  std::cout << "\n"
            << "shape    alpha   -> alpha   SSIM    RMS, % of the display's range\n";
  for (const PreviewFigure& figure : preview.figures)
    std::cout << std::left << std::setw(9) << shape_name(figure.shape) << std::setw(8) << std::defaultfloat
              << std::setprecision(3) << figure.alpha << std::fixed << std::setprecision(4) << std::setw(11)
              << figure.target_alpha << std::setw(8) << figure.ssim << std::setprecision(2)
              << 100.0 * figure.rms << (figure.in_domain ? "" : "   outside the domain") << "\n";
}

nlohmann::ordered_json similarity_json(const LitSimilarity& similarity) {
  return {{"ssim", similarity.ssim}, {"rms", similarity.rms}};
}

void print_lit_json(const PreviewCommand& command, const remap::Fit& fit, const LitPreview& preview) {
  nlohmann::ordered_json figures = nlohmann::ordered_json::array();
  for (const LitFigure& figure : preview.figures)
    figures.push_back({{"alpha", figure.alpha},
                       {"target_alpha", figure.target_alpha},
                       {"target_specular", figure.target_specular},
                       {"in_domain", figure.in_domain},
                       {"copied", similarity_json(figure.copied)},
                       {"converted", similarity_json(figure.converted)}});
  nlohmann::ordered_json json = {{"fit", fit.id},
                                 {"source", fit.source.model},
                                 {"target", fit.target.model},
                                 {"environment", command.environment},
                                 {"specular", preview.specular},
                                 {"figures", figures}};
  if (!command.output.empty()) json["picture"] = command.output.string();
  std::cout << json.dump(2) << "\n";
}

void print_lit_text(const PreviewCommand& command, const remap::Fit& fit, const LitPreview& preview) {
  std::cout << fit.source.model << " -> " << fit.target.model << " under " << command.environment
            << ", specular";
  for (const double value : preview.specular) std::cout << " " << remap::number_text(value);
  std::cout << "\n"
            << "alpha   -> alpha   copied: SSIM  RMS %   converted: SSIM  RMS %\n";
  for (const LitFigure& figure : preview.figures)
    std::cout << std::left << std::defaultfloat << std::setprecision(3) << std::setw(8) << figure.alpha
              << std::fixed << std::setprecision(4) << std::setw(11) << figure.target_alpha << std::setw(14)
              << figure.copied.ssim << std::setprecision(2) << std::setw(8) << 100.0 * figure.copied.rms
              << std::setprecision(4) << std::setw(17) << figure.converted.ssim << std::setprecision(2)
              << 100.0 * figure.converted.rms << (figure.in_domain ? "" : "   outside the domain") << "\n";
}

// Under an environment: the source, copied numbers, converted numbers.
void run_lit(const PreviewCommand& command, const remap::Fit& fit) {
  const Environment environment = environment_for_preview(command.environment, command.exposure);
  LitPreviewOptions options;
  options.alphas = command.alphas;
  options.specular = command.specular;
  options.diffuse = command.diffuse;
  options.resolution = command.resolution;
  options.samples_per_axis = command.pixel_samples;
  options.directions = command.directions;
  const LitPreview preview = make_lit_preview(fit, environment, options);
  if (!command.output.empty()) write_png(command.output, preview.sheet);
  if (command.json)
    print_lit_json(command, fit, preview);
  else
    print_lit_text(command, fit, preview);
}

void run(const PreviewCommand& command) {
  remap::watch_interruptions();
  if (!command.environment.empty()) return run_lit(command, find_fit(command.fit, command.fit_folder));
  const PreviewOptions options = preview_options(command);
  const remap::Fit fit = find_fit(command.fit, command.fit_folder);
  const auto renderer = make_renderers(command.renderers);
  const Preview preview = make_preview(*renderer, fit, options);
  if (!command.output.empty()) write_png(command.output, preview.sheet);
  if (command.json)
    print_json(command, fit, preview);
  else
    print_text(fit, preview);
}

void add_environment_options(remap::Command& command, PreviewCommand& options) {
  command.option_group("Environment");
  command
      .add_option("--environment", options.environment,
                  "Light spheres by sky, overcast, studio, or a map (EXR, HDR) instead of one light; one row "
                  "per alpha: source, numbers copied, numbers converted")
      ->type_name("NAME or FILE")
      ->excludes(command.option("--light"))
      ->excludes(command.option("--shape"));
  command.add_option("--exposure", options.exposure, "Mean luminance of the environment")
      ->capture_default_str();
  command.add_option("--diffuse", options.diffuse, "Diffuse reflectance of all spheres, 0 to 1")
      ->capture_default_str();
  command.add_option("--directions", options.directions, "Light directions per sample of a pixel")
      ->range(16, 65536)
      ->capture_default_str();
}

void require_environment(const remap::Command& command, const PreviewCommand& options) {
  for (const char* option : {"--exposure", "--diffuse", "--directions"})
    if (options.environment.empty() && command.count(option) > 0)
      throw remap::Error(remap::ErrorKind::kUsage, std::string(option) + " needs --environment");
}

}  // namespace

void add_preview_command(remap::Command& app) {
  remap::Command* command = app.add_subcommand(
      "preview", "Render a source model and its conversion side by side, and print their similarity");
  command->group(kLookStage);
  auto options = std::make_shared<PreviewCommand>();
  command->add_option("fit", options->fit, "Fit: file, or id in the folder of fits")->required();
  command->option_group("Input");
  command->add_option("--fits", options->fit_folder, "Folder where ids are looked up")
      ->type_name("FOLDER")
      ->capture_default_str();
  command->option_group("Output");
  command
      ->add_option("-o,--output", options->output,
                   "PNG to write: a column per alpha; source, conversion, and their difference times four")
      ->type_name("FILE");
  command->add_flag("--json", options->json, "Print the figures as JSON to standard output");
  command->option_group("Materials and pictures");
  command
      ->add_option("--alpha", options->alphas,
                   "Alphas of the source, comma-separated (default: four values of the fit's domain)")
      ->type_name("ALPHA,...")
      ->delimiter(',');
  command
      ->add_option("--specular", options->specular,
                   "Specular of the source (default: half the maximum of the fit's domain)")
      ->type_name("VALUE or R,G,B")
      ->delimiter(',');
  command->add_option("--shape", options->shapes, "Shapes, comma-separated: sphere, torus")
      ->type_name("SHAPE,...")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--light", options->light, "Light: headlight, or degrees from the camera")
      ->type_name("LIGHT")
      ->capture_default_str();
  command->add_option("--resolution", options->resolution, "Width and height of each picture")
      ->range(16, 2048)
      ->capture_default_str();
  add_environment_options(*command, *options);
  command->option_group(remap::kRareOptions);
  command->add_option("--distance", options->distance, "Distance of the light, in sphere radii")
      ->capture_default_str();
  command
      ->add_option("--pixel-samples", options->pixel_samples, "N x N samples per pixel; 1: the pixel center")
      ->range(1, 16)
      ->capture_default_str();
  add_renderer_options(*command, options->renderers);
  command->footer(
      "Example:\n"
      "  remapc preview mitsuba_ward_to_mitsuba_ggx --specular 0.4,0.3,0.1 \\\n"
      "    -o preview.png\n"
      "  remapc preview mitsuba_ward_to_mitsuba_as --environment studio \\\n"
      "    -o preview.png");
  command->callback([options, command] {
    require_environment(*command, *options);
    run(*options);
  });
}

}  // namespace remapc
