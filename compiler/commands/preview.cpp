// This file is `remapc preview`, which compares a source with its conversion, as pictures and figures.
#include "report/preview.hpp"

#include <algorithm>
#include <functional>
#include <iomanip>
#include <iostream>
#include <iterator>

#include "build/fit_folder.hpp"
#include "command_line/progress.hpp"
#include "command_line/run_app.hpp"
#include "commands/commands.hpp"
#include "commands/option_readers.hpp"
#include "commands/share_progress.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json.hpp"
#include "core/number_text.hpp"
#include "look/image.hpp"
#include "texremap/plan/asset_formats.hpp"
#include "worker/renderer_set.hpp"

namespace remap {
namespace {

constexpr int kUnsharedDirections = 2048;

struct PreviewCommand {
  std::string subject;  // a fit, or a folder of texture sets
  ModelName from, to;
  UsedConverters converters;
  bool recursive = false;
  std::filesystem::path fit_folder, output;
  std::vector<std::string> lights;  // if empty, default_light()
  double distance = 3.0, exposure = 1.0;
  PreviewOptions options;  // its lights are set when the command runs
  bool bare = false, force = false, json = false;
  std::string renderer_before, renderer_after;
  RendererOptions renderers;
};

Json similarity_json(const PictureError& similarity) {
  return {{"ssim", similarity.ssim}, {"rms", similarity.rms}};
}

Json figure_json(const PreviewFigure& figure) {
  return {{"light", figure.light},
          {"shape", shape_name(figure.shape)},
          {"alpha", figure.alpha},
          {"target_alpha", figure.target_alpha},
          {"target_specular", figure.target_specular},
          {"in_domain", figure.in_domain},
          {"copied", similarity_json(figure.copied)},
          {"converted", similarity_json(figure.converted)}};
}

void print(const PreviewFigure& figure) {
  std::cout << std::left << std::setw(12) << figure.light << std::setw(8) << shape_name(figure.shape)
            << std::defaultfloat << std::setprecision(3) << std::setw(8) << figure.alpha << std::fixed
            << std::setprecision(4) << std::setw(11) << figure.target_alpha;
  for (const PictureError& similarity : {figure.copied, figure.converted})
    std::cout << std::setprecision(4) << std::setw(8) << similarity.ssim << std::setprecision(2)
              << std::setw(11) << 100.0 * similarity.rms;
  std::cout << (figure.in_domain ? "" : "outside the domain") << "\n";
}

void print(const Fit& fit, const Preview& preview) {
  std::cout << fit.source.model << " -> " << fit.target.model << ", specular";
  for (const double value : preview.specular) std::cout << " " << number_text(value);
  std::cout << "\nRMS in % of the display's range     copied:            converted:\n"
               "light       shape   alpha   -> alpha   SSIM    RMS        SSIM    RMS\n";
  for (const PreviewFigure& figure : preview.figures) print(figure);
}

Json preview_json(const PreviewCommand& command, const Fit& fit, const Preview& preview) {
  Json json = {{"fit", fit.id}, {"source", fit.source.model}, {"target", fit.target.model}};
  json["specular"] = preview.specular;
  json["figures"] = Json::list();
  for (const PreviewFigure& figure : preview.figures) json["figures"].push_back(figure_json(figure));
  if (!command.output.empty()) json["picture"] = command.output.string();
  return json;
}

PreviewOptions with_lights(const Command& given, const PreviewCommand& command, const Fit& fit) {
  PreviewOptions options = command.options;
  std::vector<std::string> words = command.lights;
  if (words.empty()) words = {default_light(fit, options.shapes)};
  for (const std::string& word : words)
    options.lights.push_back(preview_light(word, command.distance, command.exposure));
  const auto is_environment = [](const PreviewLight& light) {
    return std::holds_alternative<Environment>(light.light);
  };
  const auto environments = std::ranges::count_if(options.lights, is_environment);
  const auto require = [&](const char* option, bool has_such_light, const std::string& light) {
    if (!has_such_light && given.count(option) > 0)
      throw usage_error(std::string(option) + " needs " + light);
  };
  for (const char* option : {"--exposure", "--directions"})
    require(option, environments > 0, "an environment as --light (add --light studio)");
  require("--distance", environments < std::ssize(options.lights),
          "a light that is not an environment (add --light 45)");
  return options;
}

Json figure_json(const SetFigure& figure) {
  return {{"name", figure.name},
          {"copied", figure.copied ? similarity_json(*figure.copied) : Json()},
          {"converted", similarity_json(figure.converted)},
          {"outside_domain", figure.outside}};
}

void print(const SetFigure& figure, const std::string& copied) {
  const auto text = [](const PictureError& of) {
    return "error " + fixed(100.0 * of.rms, 2) + " %, SSIM " + fixed(of.ssim, 4);
  };
  std::cout << figure.name << ": converted " << text(figure.converted)
            << (figure.copied ? "; " + copied + " " + text(*figure.copied) : "")
            << (figure.outside > 0.0
                    ? "; " + fixed(100.0 * figure.outside, 1) + " % of the texels outside the domain"
                    : "")
            << "\n";
}

// Interprets the conversion like `texremap convert`, but writes nothing.
ConvertPlan plan_of(const PreviewCommand& command) {
  ConvertOptions options;
  options.folder = command.subject;
  options.from = command.from;
  options.to = command.to;
  options.converters = command.converters;
  options.recursive = command.recursive;
  // Planning requires a path for the results, but a preview writes nothing there.
  options.output =
      std::filesystem::path(command.subject) / (is_obj_name(command.subject) ? "preview.glb" : "preview");
  options.dry_run = options.force = true;
  return resolve(std::move(options));
}

void run_sets(const Command& given, const PreviewCommand& command) {
  for (const char* option :
       {"--fits", "--alpha", "--specular", "--shape", "--diffuse", "--distance", "--pixel-samples"})
    if (given.count(option) > 0)
      throw usage_error(std::string(option) + ": applies to fits only (remove this option)");
  const bool has_renderer = !command.renderer_before.empty() || !command.renderer_after.empty();
  if (given.count("--worker") > 0 && !has_renderer)
    throw usage_error(
        "--worker: for texture sets, also name the worker as a renderer (add --renderer-before NAME or "
        "--renderer-after NAME)");
  if (command.lights.size() > 1) throw usage_error("--light: give one light for texture sets");
  const std::string word = command.lights.empty() ? "studio" : command.lights.front();
  const PreviewLight light = preview_light(word, command.distance, command.exposure);
  if (!std::holds_alternative<Environment>(light.light))
    throw usage_error("--light: texture sets need an environment (use sky, overcast, studio, or a file)");
  SetPreviewOptions options;
  options.light = std::get<Environment>(light.light);
  if (given.count("--resolution") > 0) options.resolution = command.options.resolution;
  // Pictures of different renderers do not share light directions, so their noise does not cancel, and more
  // directions are needed.
  if (has_renderer) options.directions = kUnsharedDirections;
  if (given.count("--directions") > 0)
    options.directions = options.external_directions = command.options.directions;
  options.renderer_before = command.renderer_before;
  options.renderer_after = command.renderer_after;
  std::unique_ptr<RendererSet> renderers;
  if (has_renderer) {
    RendererOptions connection = command.renderers;
    // A preview renders one picture at a time, so that one process can use all cores.
    if (connection.settings.processes == 0) connection.settings.processes = 1;
    // A picture with maps takes minutes in a slow renderer.
    if (given.count("--worker-timeout") == 0) connection.settings.seconds = 1800.0;
    renderers = make_renderers(connection);
    options.renderers = renderers.get();
  }
  const ConvertPlan plan = plan_of(command);
  options.source = !command.from.empty()    ? command.from.word()
                   : plan.sets() == nullptr ? "as its file says"
                                            : plan.conversion.source;
  options.target = command.to.empty() ? plan.conversion.target : command.to.word();
  if (!command.renderer_before.empty()) options.source += "\nin " + command.renderer_before;
  if (!command.renderer_after.empty()) options.target += "\nin " + command.renderer_after;
  const SetPreview preview = [&] {
    ShareProgress progress("preview", command.subject);
    options.progress = std::ref(progress);
    return preview_sets(plan, options);
  }();
  for (const std::string& note : preview.notes) print_message("remapc", "note: " + note);
  if (!command.output.empty())
    write_png(command.output, command.bare ? preview.sheet : labelled(preview.sheet, preview.labels));
  if (!command.json) {
    for (const SetFigure& figure : preview.figures) print(figure, preview.copied_title);
    return;
  }
  Json json = {
      {"source", plan.conversion.source}, {"target", plan.conversion.target}, {"notes", preview.notes}};
  json["figures"] = Json::list();
  for (const SetFigure& figure : preview.figures) json["figures"].push_back(figure_json(figure));
  if (!command.output.empty()) json["picture"] = command.output.string();
  std::cout << json.dump(2) << "\n";
}

void run(const Command& given, const PreviewCommand& command) {
  watch_interruptions();
  require_new(command.output, command.force);
  std::error_code ignored;
  if (!command.to.empty() || is_asset_name(command.subject) ||
      std::filesystem::is_directory(command.subject, ignored))
    return run_sets(given, command);
  for (const char* option : {"--renderer-before", "--renderer-after"})
    if (given.count(option) > 0)
      throw usage_error(std::string(option) +
                        ": applies to texture sets and assets only (remove this option)");
  const Fit fit = find_fit(command.subject, command.fit_folder);
  PreviewOptions options = with_lights(given, command, fit);
  const Preview preview = [&] {
    ShareProgress progress("preview", fit.id);
    options.progress = std::ref(progress);
    return make_preview(*make_renderers(command.renderers), fit, options);
  }();
  if (!command.output.empty())
    write_png(command.output, command.bare ? preview.sheet : labelled(preview.sheet, preview.labels));
  if (command.json)
    std::cout << preview_json(command, fit, preview).dump(2) << "\n";
  else
    print(fit, preview);
}

}  // namespace

void add_preview_command(Command& app) {
  Command* command = app.add_subcommand(
      "preview", "Render a source and its conversion side by side, for a fit or your own material",
      kLookStage);
  PreviewCommand& options =
      set_work<PreviewCommand>(*command, [command](const PreviewCommand& given) { run(*command, given); });
  command
      ->add_option("subject", options.subject,
                   "Fit: file, or id in the folder of fits; or your material: a folder of texture sets, or a "
                   "glTF, MTL or OBJ file")
      ->required();
  command->option_group("Input");
  command->add_option("--from MODEL", options.from, model_name(),
                      "Model of the texture sets (default: detected from the maps)");
  command->add_option("--to MODEL", options.to, model_name(), "Model that the texture sets become");
  options.converters.add_option(*command);
  command->add_flag("-r,--recursive", options.recursive, "Find texture sets in subfolders, too");
  add_fits_option(*command, options.fit_folder, "Folder where ids are looked up");
  command->option_group("Output");
  command->add_option(
      "-o,--output FILE", options.output,
      "PNG to write: a row per light, shape and alpha; columns: source, numbers copied, numbers converted");
  command->add_flag("--no-labels", options.bare, "Write only the pictures, without names and numbers");
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
      ->add_option("--light LIGHT,...", options.lights,
                   "Lights, comma-separated: headlight, degrees from the camera, or an environment, which "
                   "lights spheres of built-in models: sky, overcast, studio, or a map (EXR, HDR) (default: "
                   "studio; 45 for models of workers and other shapes)")
      ->delimiter(',');
  command->add_option("--exposure", options.exposure, "Mean luminance of environments")->positive();
  command->add_option("--diffuse", options.options.diffuse, "Diffuse reflectance of all pictures, 0 to 1");
  command->add_option("--resolution", options.options.resolution, "Width and height of each picture")
      ->range(16, 2048);
  command->option_group(kRareOptions);
  command->add_option("--distance", options.distance,
                      "Distance of a light that is not an environment, in sphere radii");
  command
      ->add_option("--directions", options.options.directions, "Light directions of an environment per pixel")
      ->range(16, 65536);
  command
      ->add_option(
          "--pixel-samples", options.options.samples_per_axis,
          "N x N samples per pixel; under an environment, only at the edge of the shape; 1: the pixel center")
      ->range(1, 16);
  command->option_group("Real renderers (texture sets and assets)");
  command->add_option("--renderer-before NAME", options.renderer_before,
                      "Renderer that shows the source: cycles-5, mitsuba3, threejs-r187, or a worker with "
                      "maps (default: the built-in renderer)");
  command->add_option("--renderer-after NAME", options.renderer_after,
                      "Renderer that shows the copied numbers and the converted ones");
  add_renderer_options(*command, options.renderers);
  command->footer(
      "Example:\n"
      "  remapc preview textures --from blender --to unity -o sheet.png\n"
      "  remapc preview model.glb -o sheet.png\n"
      "  remapc preview textures --to blender --renderer-before mitsuba3 \\\n"
      "    --renderer-after cycles-5 -o sheet.png\n"
      "  remapc preview mitsuba_ward_to_mitsuba_ggx --specular 0.4,0.3,0.1 \\\n"
      "    -o preview.png\n"
      "  remapc preview mitsuba_ward_to_mitsuba_as --light 45,sky -o preview.png");
}

}  // namespace remap
