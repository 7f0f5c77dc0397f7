// This file is `remapc warp`. It gives one texture set the reflectance of another, guided by strokes. Pairs
// of texture sets get a converter. If one side is a table (measured BRDFs or profiles), texels are copied.
#include "warp/warp.hpp"

#include <iostream>

#include "command_line/run_app.hpp"
#include "commands/commands.hpp"
#include "commands/option_readers.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json.hpp"
#include "core/number_text.hpp"
#include "core/system.hpp"
#include "lower/fit_file.hpp"
#include "remap/version.hpp"
#include "report/warp_report.hpp"
#include "warp/strokes.hpp"
#include "warp/texture_material.hpp"

namespace remap {
namespace {

struct WarpCommand {
  std::string source, target;
  std::string source_model = "mitsuba/ggx", target_model = "mitsuba/ggx";
  std::vector<std::string> masks, boxes, paintings;  // source, template, source, template ...
  std::string distance;  // if empty: plain if both materials are profiles, otherwise relative
  bool exact = false;
  std::filesystem::path output, copy, report;
  bool force = false, json = false;
};

// Returns the stroke pairs of all options. There is at least one.
std::vector<StrokePair> strokes_of(const WarpCommand& command, const MaterialRef& source,
                                   const MaterialRef& target) {
  std::vector<StrokePair> strokes;
  for (std::size_t i = 0; i + 1 < command.masks.size(); i += 2)
    strokes.push_back({read_stroke(command.masks[i], source), read_stroke(command.masks[i + 1], target)});
  for (std::size_t i = 0; i + 1 < command.boxes.size(); i += 2)
    strokes.push_back({box_stroke(command.boxes[i], source), box_stroke(command.boxes[i + 1], target)});
  for (std::size_t i = 0; i + 1 < command.paintings.size(); i += 2)
    for (StrokePair& pair :
         read_color_strokes(command.paintings[i], source, command.paintings[i + 1], target))
      strokes.push_back(std::move(pair));
  if (strokes.empty())
    throw usage_error(
        "no strokes given (use --strokes SOURCE_IMAGE TEMPLATE_IMAGE, --stroke SOURCE_MASK TEMPLATE_MASK, or "
        "--box SOURCE_BOX TEMPLATE_BOX)");
  return strokes;
}

AppearanceDistance distance_of(const WarpCommand& command, AppearanceDistance usual) {
  return value_named(kAppearanceDistances, command.distance).value_or(usual);
}

WarpMapFit fit_file(const WarpCommand& command, const WarpFit& fit, std::size_t stroke_count) {
  WarpMapFit file;
  file.id = command.output.empty() ? "warp" : command.output.stem().string();
  file.source_model = command.source_model;
  file.template_model = command.target_model;
  file.warp = fit.compiled;
  file.method = {{"method", "registration"},
                 {"distance", command.distance.empty() ? std::string("relative") : command.distance},
                 {"strokes", std::to_string(stroke_count)},
                 {"source", std::filesystem::path(command.source).filename().string()},
                 {"template", std::filesystem::path(command.target).filename().string()}};
  file.remarks = warnings_of(fit.diagnostics);
  file.tool_version = kVersion;
  return file;
}

// Returns names and values for the report.
std::vector<std::pair<std::string, std::string>> facts_of(const WarpCommand& command, const WarpFit& fit,
                                                          const WarpMapFit& file) {
  const WarpDiagnostics& found = fit.diagnostics;
  return {
      {"source", command.source + ", " + command.source_model},
      {"template", command.target + ", " + command.target_model},
      {"stroke pairs", file.method.at("strokes")},
      {"dimensions", std::to_string(found.dimensions) + " (source " +
                         std::to_string(found.source_dimensions) + ", template " +
                         std::to_string(found.target_dimensions) + ")"},
      {"stress of source, of template", percent(found.source_stress) + ", " + percent(found.target_stress)},
      {"directions fixed by strokes", std::to_string(found.fixed_directions)},
      {"part of the template that is used", percent(found.coverage)},
      {"part of the source inside folds", percent(found.fold_share)},
      {"distance of strokes after the warp, relative to the template's spread",
       percent(found.stroke_distance)},
      {"size of the converter in bytes", std::to_string(byte_count(fit.compiled))}};
}

Json report_of(const WarpDiagnostics& found) {
  return {{"dimensions", found.dimensions},
          {"source_dimensions", found.source_dimensions},
          {"template_dimensions", found.target_dimensions},
          {"source_stress", found.source_stress},
          {"template_stress", found.target_stress},
          {"fixed_directions", found.fixed_directions},
          {"fold_share", found.fold_share},
          {"template_used", found.coverage},
          {"stroke_distance", found.stroke_distance},
          {"stroke_distance_affine", found.stroke_contradiction},
          {"strokes", found.strokes},
          {"worst_stroke", found.worst_stroke + 1},
          {"largest_overlap", found.shared.share},
          {"source_texels_left_out", found.source_left_out},
          {"template_texels_left_out", found.target_left_out}};
}

// Prints the diagnostics and warnings in words. `name` is the main file that was written.
void print_words(const std::filesystem::path& name, const WarpDiagnostics& found,
                 const std::string& more = "") {
  std::cerr << name.string() << ": warp in " << found.dimensions << " dimensions from "
            << found.strokes.size() << " stroke pairs\n  template used " << percent(found.coverage)
            << ", source folded " << percent(found.fold_share) << ", distance of strokes "
            << percent(found.stroke_distance) << " of the template's spread\n"
            << more;
  for (const std::string& warning : warnings_of(found)) print_message("remapc", "warning: " + warning);
}

void require_outputs(const WarpCommand& command) {
  if (command.output.empty() && command.copy.empty())
    throw usage_error("--output is required (or --copy FOLDER)");
  if (!command.output.empty() && !is_valid_id(command.output.stem().string()))
    throw usage_error("--output: " + command.output.string() +
                      " is not usable as an id (use letters, digits and single underscores before .json)");
  if (!command.report.empty()) require_report_path(command.report);
}

void warp_textures(const WarpCommand& command) {
  require_outputs(command);
  const WarpMaterial source =
      read_texture_material(command.source, command.source_model, AlbedoAlone::kEnrich);
  const WarpMaterial target = read_texture_material(command.target, command.target_model);
  const std::vector<StrokePair> strokes = strokes_of(command, source, target);
  const Stopwatch stopwatch;
  const WarpFit fit =
      fit_warp(source, target, strokes, distance_of(command, AppearanceDistance::kRelative), command.exact);
  const double seconds = stopwatch.seconds();
  WarpMapFit file = fit_file(command, fit, strokes.size());
  if (source.is_albedo) file.method[kWarpSourceMaps] = kDiffuseAlone;
  file.copy_rms_error = rounded_up(copy_rms_error(fit, source, target), 3);

  Json json;
  if (!command.output.empty()) {
    write_file(command.output, fit_to_json(file));
    json["fit"] = command.output.string();
  }
  if (!command.copy.empty())
    for (const std::filesystem::path& copy :
         write_copied_set(command.copy, copy_exactly(fit, source, target), source, target))
      json["copies"].push_back(copy.string());
  if (!command.report.empty()) {
    WarpReport report = warp_report(source, target, strokes, fit);
    report.title = "Warp " + file.id;
    report.facts = facts_of(command, fit, file);
    report.warnings = file.remarks;
    write_warp_report(command.report, report);
  }
  if (command.json) {
    json.update({{"bytes", byte_count(fit.compiled)},
                 {"seconds", seconds},
                 {"copy_rms_error", file.copy_rms_error},
                 {"diagnostics", report_of(fit.diagnostics)},
                 {"warnings", file.remarks}});
    std::cout << json.dump(2) << "\n";
    return;
  }
  std::string more = "  compiled to " + std::to_string(byte_count(fit.compiled)) +
                     " bytes; RMS difference to an exact copy " + percent(file.copy_rms_error) +
                     " of the template's spread\n";
  if (source.is_albedo)
    more +=
        "  the source has only a diffuse map, so remapc uses specular 0 and alpha 1, and its colors show the "
        "materials\n";
  print_words(command.output.empty() ? command.copy : command.output, fit.diagnostics, more);
}

using MaterialSet = std::variant<WarpMaterial, TabulatedMaterial>;

MaterialSet read_material_set(const std::string& folder, const std::string& model) {
  if (is_tabulated_folder(folder)) return read_tabulated_set(folder);
  return read_texture_material(folder, model);
}

MaterialRef ref_of(const MaterialSet& set) {
  return std::visit([](const auto& material) { return MaterialRef(material); }, set);
}

void require_copy_alone(const WarpCommand& command) {
  const std::string table = is_tabulated_folder(command.source) ? command.source : command.target;
  if (!command.output.empty() || command.copy.empty())
    throw usage_error(table + ": a table cannot be fitted (use --copy FOLDER instead of --output)");
  if (!command.report.empty())
    throw usage_error("--report: not available for tables such as " + table + " (remove this option)");
}

// Copies texels, because a table has no parameters to fit.
void warp_tables(const WarpCommand& command) {
  require_copy_alone(command);
  const MaterialSet source = read_material_set(command.source, command.source_model),
                    target = read_material_set(command.target, command.target_model);
  const MaterialRef from = ref_of(source), to = ref_of(target);
  const AppearanceDistance usual =
      from.is_profiles() ? AppearanceDistance::kPlain : AppearanceDistance::kRelative;
  const AppearanceMatch match =
      match_appearances(from, to, strokes_of(command, from, to), distance_of(command, usual));
  const auto files = write_copied_set(command.copy, copy_exactly(match, from, to), from, to);
  if (!command.json) return print_words(command.copy, match.diagnostics);
  Json json = {{"diagnostics", report_of(match.diagnostics)}, {"warnings", warnings_of(match.diagnostics)}};
  for (const std::filesystem::path& file : files) json["files"].push_back(file.string());
  std::cout << json.dump(2) << "\n";
}

void run(const WarpCommand& command) {
  for (const std::filesystem::path& path : {command.output, command.report}) require_new(path, command.force);
  if (!command.copy.empty())
    for (const char* name : kCopyNames) require_new(command.copy / name, command.force);
  if (is_tabulated_folder(command.source) || is_tabulated_folder(command.target))
    warp_tables(command);
  else
    warp_textures(command);
}

void add_stroke_options(Command& app, WarpCommand& command) {
  app.option_group("Strokes");
  app.add_option("--strokes SOURCE_IMAGE TEMPLATE_IMAGE", command.paintings,
                 "Two images with one color for each region; the background is transparent or the most "
                 "frequent color")
      ->type_size(2);
  app.add_option("--stroke SOURCE_MASK TEMPLATE_MASK", command.masks,
                 "Two masks that mark one region; may be repeated")
      ->type_size(2);
  app.add_option("--box SOURCE_BOX TEMPLATE_BOX", command.boxes,
                 "Two boxes of texels, each x0,y0,x1,y1, that mark one region; may be repeated")
      ->type_size(2)
      ->delimiter(' ');
}

void add_model_options(Command& app, WarpCommand& command) {
  app.option_group("Models");
  app.add_option("--source-model MODEL", command.source_model, "BRDF model of the source's maps");
  app.add_option("--template-model MODEL", command.target_model,
                 "BRDF model of the template's maps and of the result");
  app.add_flag("--exact", command.exact, "Copy texels of the template instead of blending them");
  app.option_group(kRareOptions);
  app.add_option("--distance", command.distance,
                 "Distance between reflectances (default: relative; plain for scattering profiles)")
      ->one_of(names_of(kAppearanceDistances));
}

}  // namespace

void add_warp_command(Command& app) {
  Command* command = app.add_subcommand(
      "warp", "Give one texture set the reflectance of another, guided by strokes (An et al. 2011)",
      kWarpStage);
  WarpCommand& options = set_work<WarpCommand>(*command, run);
  command
      ->add_option("source", options.source,
                   "Folder of the set that keeps its pattern; it may have only a diffuse map")
      ->required();
  command->add_option("template", options.target, "Folder of the set whose reflectance is used")->required();
  add_stroke_options(*command, options);
  command->option_group("Output");
  command->add_option("-o,--output FILE", options.output, "File for the fit; its name is the fit's id");
  command->add_option("--copy FOLDER", options.copy,
                      "Folder for the exact copy: maps of texels copied from the template, and an index map");
  command->add_option(
      "--report FILE", options.report,
      "HTML page with pictures of materials, strokes, appearance spaces and result, and the diagnostics");
  add_force_flag(*command, options.force);
  command->add_flag("--json", options.json, "Print the diagnostics as JSON to standard output");
  add_model_options(*command, options);
  command->footer(
      "Example:\n"
      "  remapc warp brown_leaf green_leaf \\\n"
      "    --stroke brown_stem.png green_stem.png \\\n"
      "    --stroke brown_body.png green_body.png -o leaf.json");
}

}  // namespace remap
