// `remapc warp` gives one texture set the reflectance of another, guided by strokes.
#include <chrono>
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>

#include "command_line/command.hpp"
#include "command_line/run_app.hpp"
#include "commands/commands.hpp"
#include "commands/warp_command.hpp"
#include "remap/error.hpp"
#include "remap/fit_file.hpp"
#include "remap/version.hpp"
#include "report/warp_report.hpp"
#include "system/files.hpp"
#include "text/number_text.hpp"
#include "text/report_text.hpp"
#include "warp/copy_error.hpp"
#include "warp/input/copied_set.hpp"
#include "warp/input/tabulated_set.hpp"
#include "warp/input/texture_material.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

remap::WarpMapFit fit_file(const WarpCommand& command, const WarpFit& fit, std::size_t stroke_count) {
  remap::WarpMapFit file;
  file.id = command.output.empty() ? "warp" : command.output.stem().string();
  file.source_model = command.source_model;
  file.template_model = command.target_model;
  file.warp = fit.compiled;
  file.method = {{"method", command.method},
                 {"distance", command.distance.empty() ? std::string("relative") : command.distance},
                 {"strokes", std::to_string(stroke_count)},
                 {"source", std::filesystem::path(command.source).filename().string()},
                 {"template", std::filesystem::path(command.target).filename().string()}};
  file.remarks = warnings_of(fit.diagnostics);
  file.tool_version = remap::kVersion;
  return file;
}

WarpWords words_of(const WarpCommand& command, const WarpFit& fit, const remap::WarpMapFit& file) {
  const WarpDiagnostics& found = fit.diagnostics;
  return {
      "Warp " + file.id,
      {{"source", command.source + ", " + command.source_model},
       {"template", command.target + ", " + command.target_model},
       {"method", command.method + ", " + file.method.at("strokes") + " stroke pairs"},
       {"dimensions", std::to_string(found.dimensions) + " (source " +
                          std::to_string(found.source_dimensions) + ", template " +
                          std::to_string(found.target_dimensions) + ")"},
       {"stress of source, of template", percent(found.source_stress) + ", " + percent(found.target_stress)},
       {"directions fixed by strokes", std::to_string(found.fixed_directions)},
       {"appearances of the template used", percent(found.coverage)},
       {"folds", percent(found.fold_share)},
       {"distance of strokes after the warp, of the template's spread", percent(found.stroke_distance)},
       {"size of the converter in bytes", std::to_string(byte_count(fit.compiled))}},
      file.remarks,
      static_cast<std::size_t>(std::stoul(file.method.at("strokes")))};
}

// A finished fit and the files that were written.
struct WarpOutcome {
  remap::WarpMapFit file;
  double seconds = 0.0;
  std::vector<std::filesystem::path> copies;
};

void print_json(const WarpCommand& command, const WarpFit& fit, const WarpOutcome& outcome) {
  nlohmann::ordered_json json;
  if (!command.output.empty()) json["fit"] = command.output.string();
  for (const std::filesystem::path& file : outcome.copies) json["copies"].push_back(file.string());
  json["bytes"] = byte_count(fit.compiled);
  json["seconds"] = outcome.seconds;
  json["copy_rms_error"] = outcome.file.copy_rms_error;
  json["diagnostics"] = report_of(fit.diagnostics);
  json["warnings"] = outcome.file.remarks;
  std::cout << json.dump(2) << "\n";
}

void print_words(const WarpCommand& command, const WarpFit& fit, const WarpOutcome& outcome, bool is_albedo) {
  const std::filesystem::path& name = command.output.empty() ? command.copy : command.output;
  std::cerr << name.string() << ": " << summary_of(fit.diagnostics) << "  compiled to "
            << byte_count(fit.compiled) << " bytes; RMS difference to an exact copy "
            << percent(outcome.file.copy_rms_error) << " of the template's spread\n";
  if (is_albedo)
    std::cerr << "  the source has a diffuse map only: specular 0 and alpha 1 assumed, materials "
                 "distinguished by color\n";
  for (const std::string& warning : outcome.file.remarks)
    remap::print_message("remapc", "warning: " + warning);
}

void require_outputs(const WarpCommand& command) {
  if (command.output.empty() && command.copy.empty())
    throw Error(ErrorKind::kUsage, "--output is required (or --copy FOLDER)");
  if (!command.output.empty() && !remap::is_valid_id(command.output.stem().string()))
    throw Error(ErrorKind::kUsage,
                "--output: " + command.output.string() +
                    " is not usable as an id (use letters, digits and single underscores before .json)");
  if (!command.report.empty()) require_report_path(command.report);
}

void warp_textures(const WarpCommand& command) {
  require_outputs(command);
  const TextureMaterial source =
      read_texture_material(command.source, command.source_model, AlbedoAlone::kEnrich);
  const TextureMaterial target = read_texture_material(command.target, command.target_model);
  const std::vector<StrokePair> strokes = strokes_of(command, source.frame(), target.frame());
  const auto start = std::chrono::steady_clock::now();
  const WarpFit fit =
      fit_warp(source.material, target.material, strokes, options_of(command, AppearanceDistance::kRelative));
  WarpOutcome outcome;
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  outcome.file = fit_file(command, fit, strokes.size());
  if (source.is_albedo) outcome.file.method[remap::kWarpSourceMaps] = remap::kDiffuseAlone;
  outcome.file.copy_rms_error = remap::rounded_up(copy_rms_error(fit, source.material, target.material), 3);
  if (!command.output.empty()) remap::write_file(command.output, fit_to_json(outcome.file));
  if (!command.copy.empty())
    outcome.copies = write_copied_set(command.copy, copy_exactly(fit, source.material, target.material),
                                      source.frame(), {target.material, target.frame(), {}});
  if (!command.report.empty())
    write_warp_report(command.report, warp_pictures(source, target, strokes, fit),
                      words_of(command, fit, outcome.file));
  if (command.json)
    print_json(command, fit, outcome);
  else
    print_words(command, fit, outcome, source.is_albedo);
}

void run(const WarpCommand& command) {
  if (is_tabulated_folder(command.source) || is_tabulated_folder(command.target))
    warp_tables(command);
  else
    warp_textures(command);
}

void add_stroke_options(remap::Command& app, WarpCommand& command) {
  app.option_group("Strokes");
  app.add_option(
         "--strokes", command.paintings,
         "Two images with a color for each region, on a transparent background or on the most frequent "
         "color")
      ->type_size(2)
      ->type_name("SOURCE_IMAGE TEMPLATE_IMAGE");
  app.add_option("--stroke", command.masks, "Two masks that mark one region; may be repeated")
      ->type_size(2)
      ->type_name("SOURCE_MASK TEMPLATE_MASK");
  app.add_option("--box", command.boxes,
                 "Two boxes of texels, each x0,y0,x1,y1, that mark one region; may be repeated")
      ->type_size(2)
      ->delimiter(' ')
      ->type_name("SOURCE_BOX TEMPLATE_BOX");
}

void add_method_options(remap::Command& app, WarpCommand& command) {
  app.option_group("Models and method");
  app.add_option("--source-model", command.source_model, "BRDF model of the source's maps")
      ->type_name("MODEL")
      ->capture_default_str();
  app.add_option("--template-model", command.target_model,
                 "BRDF model of the template's maps and of the result")
      ->type_name("MODEL")
      ->capture_default_str();
  app.add_flag("--exact", command.exact, "Copy texels of the template instead of blending them");
  app.option_group(remap::kRareOptions);
  app.add_option("--method", command.method, "Method that finds the warp")
      ->one_of(method_names())
      ->capture_default_str();
  app.add_option("--distance", command.distance,
                 "Distance between reflectances (default: relative; plain for scattering profiles)")
      ->one_of(distance_names());
  app.add_option("--dimensions", command.dimensions, "Dimensions of appearance space, 0: as many as needed")
      ->range(0, 3)
      ->capture_default_str();
}

}  // namespace

void add_warp_command(remap::Command& app) {
  remap::Command* command = app.add_subcommand(
      "warp", "Give one texture set the reflectance of another, guided by strokes (An et al. 2011)");
  command->group(kWarpStage);
  auto options = std::make_shared<WarpCommand>();
  command
      ->add_option("source", options->source,
                   "Folder of the set that keeps its pattern; may hold a diffuse map only")
      ->required();
  command->add_option("template", options->target, "Folder of the set whose reflectance is used")->required();
  add_stroke_options(*command, *options);
  command->option_group("Output");
  command->add_option("-o,--output", options->output, "File for the fit; its name is the fit's id")
      ->type_name("FILE");
  command
      ->add_option("--copy", options->copy,
                   "Folder for the exact copy: maps of texels copied from the template, and an index map")
      ->type_name("FOLDER");
  command
      ->add_option(
          "--report", options->report,
          "Pictures of materials, strokes, appearance spaces and result: .html with the diagnostics, or "
          ".png")
      ->type_name("FILE");
  command->add_flag("--json", options->json, "Print the diagnostics as JSON to standard output");
  add_method_options(*command, *options);
  command->footer(
      "Example:\n"
      "  remapc warp brown_leaf green_leaf \\\n"
      "    --stroke brown_stem.png green_stem.png \\\n"
      "    --stroke brown_body.png green_body.png -o leaf.json");
  command->callback([options] { run(*options); });
}

}  // namespace remapc
