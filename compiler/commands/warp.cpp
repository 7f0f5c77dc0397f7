// `remapc warp`: the reflectance of one texture set for the pattern of another, by strokes.
#include "warp/warp.hpp"

#include <chrono>
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>

#include "command_line/run_app.hpp"
#include "commands/commands.hpp"
#include "error.hpp"
#include "files.hpp"
#include "model/fit_json.hpp"
#include "number_text.hpp"
#include "report/warp_report.hpp"
#include "report_text.hpp"
#include "version.hpp"
#include "warp/copy_error.hpp"
#include "warp/stroke_colors.hpp"
#include "warp/stroke_masks.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

struct WarpCommand {
  std::string source, target;
  std::string source_model = "mitsuba/ggx", target_model = "mitsuba/ggx";
  std::vector<std::string> masks, boxes, paintings;  // source, template, source, template ...
  std::string method = "registration";
  std::string distance = "relative";
  int dimensions = 0;
  bool exact = false;
  std::filesystem::path output, report;
  bool json = false;
};

std::vector<StrokePair> strokes_of(const WarpCommand& command, const TextureMaterial& source,
                                   const TextureMaterial& target) {
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
    throw Error(ErrorKind::kUsage,
                "warp: no stroke; expected --strokes SOURCE_IMAGE TEMPLATE_IMAGE, --stroke SOURCE_MASK "
                "TEMPLATE_MASK or --box pairs");
  return strokes;
}

WarpOptions options_of(const WarpCommand& command) {
  WarpOptions options;
  options.method = *method_from_name(command.method);
  options.distance = *distance_from_name(command.distance);
  options.dimensions = command.dimensions;
  options.exact = command.exact;
  return options;
}

remap::WarpMapFit fit_file(const WarpCommand& command, const WarpFit& fit, std::size_t stroke_count) {
  remap::WarpMapFit file;
  file.id = command.output.stem().string();
  if (!remap::is_valid_id(file.id))
    throw Error(ErrorKind::kUsage,
                "--output: " + command.output.string() +
                    " names the fit; expected letters, digits and single underscores before .json");
  file.source_model = command.source_model;
  file.template_model = command.target_model;
  file.warp = fit.compiled;
  file.method = {{"method", command.method},
                 {"distance", command.distance},
                 {"strokes", std::to_string(stroke_count)},
                 {"source", std::filesystem::path(command.source).filename().string()},
                 {"template", std::filesystem::path(command.target).filename().string()}};
  file.remarks = warnings_of(fit.diagnostics);
  file.tool_version = remap::kVersion;
  return file;
}

nlohmann::ordered_json report_of(const WarpDiagnostics& found) {
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
          {"largest_overlap", found.shared.overlap.share},
          {"source_texels_left_out", found.source_left_out},
          {"template_texels_left_out", found.target_left_out}};
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

void run(const WarpCommand& command) {
  if (!command.report.empty()) require_report_path(command.report);
  const TextureMaterial source =
      read_texture_material(command.source, command.source_model, AlbedoAlone::kEnrich);
  const TextureMaterial target = read_texture_material(command.target, command.target_model);
  const std::vector<StrokePair> strokes = strokes_of(command, source, target);
  const auto start = std::chrono::steady_clock::now();
  const WarpFit fit = fit_warp(source.material, target.material, strokes, options_of(command));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  remap::WarpMapFit file = fit_file(command, fit, strokes.size());
  if (source.is_albedo) file.method[remap::kWarpSourceMaps] = remap::kDiffuseAlone;
  file.copy_rms_error = remap::rounded_up(copy_rms_error(fit, source.material, target.material), 3);
  remap::write_file(command.output, fit_to_json(file));
  if (!command.report.empty())
    write_warp_report(command.report, warp_pictures(source, target, strokes, fit),
                      words_of(command, fit, file));
  if (command.json) {
    const nlohmann::ordered_json json = {{"fit", command.output.string()},
                                         {"bytes", byte_count(fit.compiled)},
                                         {"seconds", seconds},
                                         {"copy_rms_error", file.copy_rms_error},
                                         {"diagnostics", report_of(fit.diagnostics)},
                                         {"warnings", file.remarks}};
    std::cout << json.dump(2) << "\n";
    return;
  }
  std::cerr << command.output.string() << ": warp in " << fit.diagnostics.dimensions << " dimensions from "
            << strokes.size() << " stroke pairs\n  template used " << percent(fit.diagnostics.coverage)
            << ", folds " << percent(fit.diagnostics.fold_share) << ", strokes "
            << percent(fit.diagnostics.stroke_distance) << " of the template's spread apart\n  compiled to "
            << byte_count(fit.compiled) << " bytes, " << percent(file.copy_rms_error)
            << " of the spread from an exact copy\n";
  if (source.is_albedo)
    std::cerr << "  the source is diffuse alone: taken with specular 0 and alpha 1, told apart by colour\n";
  for (const std::string& warning : file.remarks) remap::print_message("remapc", "warning: " + warning);
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
                   "Two images, of the source and of the template, with a colour for each region; the "
                   "background is transparent, or the most frequent colour")
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
  command->add_option("--distance", options->distance, "How reflectances are compared")
      ->check(CLI::IsMember(distance_names()))
      ->capture_default_str();
  command
      ->add_option("--dimensions", options->dimensions,
                   "Of appearance space, 1 to 3; 0: as many as are needed")
      ->check(CLI::Range(0, 3))
      ->capture_default_str();
  command->add_flag("--exact", options->exact,
                    "Results are texels of the template as they are, no blends of them");
  command->add_option("-o,--output", options->output, "File of the fit; its name is the id")->required();
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
