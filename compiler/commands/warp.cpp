// `remapc warp`: the reflectance of one texture set for the pattern of another, by strokes.
#include <chrono>
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>

#include "command_line/run_app.hpp"
#include "commands/commands.hpp"
#include "commands/warp_command.hpp"
#include "fit_file/fit_json.hpp"
#include "remap/error.hpp"
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
       {"stress of source and template", percent(found.source_stress) + ", " + percent(found.target_stress)},
       {"directions that strokes fix", std::to_string(found.fixed_directions)},
       {"appearances of the template that are used", percent(found.coverage)},
       {"folds", percent(found.fold_share)},
       {"strokes apart, of the template's spread", percent(found.stroke_distance)},
       {"bytes of the converter", std::to_string(byte_count(fit.compiled))}},
      file.remarks,
      static_cast<std::size_t>(std::stoul(file.method.at("strokes")))};
}

// Of a fit that has been made, and where it went.
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
            << byte_count(fit.compiled) << " bytes, " << percent(outcome.file.copy_rms_error)
            << " of the spread from an exact copy\n";
  if (is_albedo)
    std::cerr << "  the source is diffuse alone: taken with specular 0 and alpha 1, told apart by color\n";
  for (const std::string& warning : outcome.file.remarks)
    remap::print_message("remapc", "warning: " + warning);
}

void require_outputs(const WarpCommand& command) {
  if (command.output.empty() && command.copy.empty())
    throw Error(ErrorKind::kUsage, "--output: is missing; expected a file for the fit, or --copy FOLDER");
  if (!command.output.empty() && !remap::is_valid_id(command.output.stem().string()))
    throw Error(ErrorKind::kUsage,
                "--output: " + command.output.string() +
                    " names the fit; expected letters, digits and single underscores before .json");
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

}  // namespace

void add_warp_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "warp", "Give one texture set the reflectance of another, by pairs of strokes (An et al. 2011)");
  auto options = std::make_shared<WarpCommand>();
  command
      ->add_option("source", options->source,
                   "Folder of the set whose pattern stays; a diffuse map alone will do")
      ->required();
  command->add_option("template", options->target, "Folder of the set whose reflectance is taken")
      ->required();
  command
      ->add_option("--stroke", options->masks,
                   "Two masks that mark one region: of the source and of the template")
      ->type_size(2)
      ->type_name("SOURCE_MASK TEMPLATE_MASK");
  command
      ->add_option("--strokes", options->paintings,
                   "Two images, of the source and of the template, with a color for each region; the "
                   "background is transparent, or the most frequent color")
      ->type_size(2)
      ->type_name("SOURCE_IMAGE TEMPLATE_IMAGE");
  command->add_option("--box", options->boxes, "The same as boxes of texels, x0,y0,x1,y1 each")
      ->type_size(2)
      ->delimiter(' ')
      ->type_name("SOURCE_BOX TEMPLATE_BOX");
  command->add_option("--source-model", options->source_model, "BRDF model of the source's maps")
      ->capture_default_str();
  command
      ->add_option("--template-model", options->target_model,
                   "BRDF model of the template's maps, and of results")
      ->capture_default_str();
  command->add_option("--method", options->method, "How the warp is found")
      ->check(CLI::IsMember(method_names()))
      ->capture_default_str();
  command
      ->add_option("--distance", options->distance,
                   "How reflectances are compared; default: relative, of scattering profiles plain")
      ->check(CLI::IsMember(distance_names()));
  command
      ->add_option("--dimensions", options->dimensions,
                   "Of appearance space, 1 to 3; 0: as many as are needed")
      ->check(CLI::Range(0, 3))
      ->capture_default_str();
  command->add_flag("--exact", options->exact,
                    "Results are texels of the template as they are, no blends of them");
  command->add_option("-o,--output", options->output, "File of the fit; its name is the id");
  command->add_option("--copy", options->copy,
                      "Folder for the exact copy: maps whose texels are those of the template, and which");
  command->add_option("--report", options->report,
                      "Pictures of materials, strokes, appearance spaces and result: one .html with all of "
                      "them and the diagnostics, or a sheet as .png");
  command->add_flag("--json", options->json, "Diagnostics as JSON on standard output");
  command->footer(
      "Example:\n  remapc warp brown_leaf green_leaf --stroke brown_stem.png green_stem.png --stroke "
      "brown_body.png green_body.png -o leaf.json");
  command->callback([options] { run(*options); });
}

}  // namespace remapc
