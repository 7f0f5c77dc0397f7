// `remap-study warp`: measures the error of appearance warps on materials whose correct result is known.
#include <filesystem>
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>

#include "remap/error.hpp"
#include "renderer/image_file.hpp"
#include "study/commands/studies.hpp"
#include "study/commands/study_options.hpp"
#include "study/warp_sheets.hpp"
#include "study/warps_report.hpp"
#include "system/files.hpp"

namespace remapc {
namespace {

struct WarpStudyCommand {
  std::vector<std::filesystem::path> sets;
  std::size_t size = 256, stroke_sets = 3;
  std::vector<std::string> materials;  // of the built-in sets; empty: all
  WarpsOptions study;
  OutputOptions output;
};

nlohmann::ordered_json summary_json(const WarpSummary& summary) {
  const WarpFigures& figures = summary.figures;
  nlohmann::ordered_json json = {{"error", figures.mean},      {"rms", figures.rms},
                                 {"median", figures.median},   {"p95", figures.p95},
                                 {"strokes", figures.strokes}, {"used", figures.used},
                                 {"tears", figures.tears},     {"variation", figures.variation}};
  if (summary.change) json["change"] = *summary.change;
  if (!summary.cost) return json;
  json["folds"] = summary.cost->folds;
  json["compiled_error"] = summary.cost->compiled.mean;
  json["table_difference"] = summary.cost->compiled.difference;
  json["bytes"] = summary.cost->bytes;
  if (summary.cost->seconds > 0.0) json["seconds"] = summary.cost->seconds;
  return json;
}

nlohmann::ordered_json report_json(const WarpsOptions& options, const WarpsResult& result) {
  nlohmann::ordered_json json = {{"width", options.cases.front().width},
                                 {"height", options.cases.front().height}};
  for (const WarpCase& studied : options.cases)
    json["sets"].push_back({{"name", studied.name}, {"stroke_sets", studied.strokes.size()}});
  for (std::size_t v = 0; v < result.variants.size(); ++v) {
    nlohmann::ordered_json entry = summary_json(summary_of(result, v));
    for (std::size_t set = 0; set < options.cases.size(); ++set)
      entry["sets"][options.cases[set].name] = summary_json(summary_of(result, v, set));
    json[group_name(result.variants[v].group)][result.variants[v].name] = entry;
  }
  return json;
}

// Writes the files of the study and returns the legends of the sheets, one line each.
std::string write_results(const WarpStudyCommand& command, const WarpsOptions& options,
                          const WarpsResult& result) {
  const std::filesystem::path& folder = command.output.folder;
  remap::write_file(folder / "warp.csv", warps_csv(options, result));
  remap::write_file(folder / "warp_sensitivity.csv", warp_sensitivity_csv(options, result));
  write_plot(folder / "warp.svg", warps_plot_script(options, result));
  std::string legends;
  if (!command.output.pictures) return legends;
  for (const WarpSheet& sheet : warp_sheets(options, result)) {
    write_png(folder / (sheet.name + ".png"), sheet.picture);
    legends += sheet.name + ".png: " + sheet.legend + ".\n";
  }
  return legends;
}

void run(const WarpStudyCommand& command) {
  require_folder_for_pictures(command.output);
  WarpsOptions options = command.study;
  options.cases = command.sets.empty()
                      ? builtin_warp_cases(command.size, command.stroke_sets, command.materials)
                      : read_warp_cases(command.sets);
  options.pictures = command.output.pictures;
  if (!command.output.folder.empty()) remap::create_parent(command.output.folder / "warp.csv");
  const WarpsResult result = run_study("warp", options, command.output.quiet, study_warps);
  std::string legends;
  if (!command.output.folder.empty()) legends = write_results(command, options, result);
  if (command.output.json)
    std::cout << report_json(options, result).dump(2) << "\n";
  else
    std::cout << warps_text(options, result) << (legends.empty() ? "" : "\n" + legends);
}

void add_options(remap::Command& app, WarpStudyCommand& command) {
  remap::Option* size =
      app.add_option("--size", command.size, "Width and height of the built-in sets in texels")
          ->capture_default_str();
  remap::Option* strokes =
      app.add_option("--stroke-sets", command.stroke_sets, "Number of stroke sets for each built-in set")
          ->capture_default_str();
  remap::Option* material =
      app.add_option("--material", command.materials, "Use only this built-in set, repeatable")
          ->allow_extra_args(false)
          ->one_of(builtin_warp_names());
  app.add_option(
         "--sets", command.sets,
         "Read the sets from the subfolders of this folder: {source,template,truth}/{diffuse,specular,"
         "alpha}.exr, strokes/{source,template}<k>.exr; repeatable, each folder with different strokes")
      ->allow_extra_args(false)
      ->excludes(size)
      ->excludes(strokes)
      ->excludes(material);
  app.add_option("-o,--output", command.output.folder,
                 "Write warp.csv, warp_sensitivity.csv and warp.svg (needs gnuplot) to this folder");
  app.add_flag(
      "--pictures", command.output.pictures,
      "Also write three sheets for each set: warp_methods, warp_sampling and warp_strokes_<set>.png");
  app.add_option("--jobs", command.study.jobs,
                 "Number of threads; 0: one per core. It affects only the measured times")
      ->capture_default_str();
  app.add_flag("--json", command.output.json, "Print the figures as JSON");
  app.add_flag("--quiet", command.output.quiet, "Do not show progress");
}

}  // namespace

void add_warp_study(remap::Command& study) {
  remap::Command* command = study.add_subcommand(
      "warp",
      "Measure every warp method on materials with a known result, in one to three dimensions, with "
      "coarse and fine sampling and with different strokes (An et al. 2011, figures 2, 3 and 7)");
  auto options = std::make_shared<WarpStudyCommand>();
  add_options(*command, *options);
  command->footer("Example:\n  remap-study warp --pictures -o warp_study");
  command->callback([options] { run(*options); });
}

}  // namespace remapc
