// `remap-study warp`: measures the error of appearance warps on materials whose correct result is known.
#include <filesystem>
#include <memory>

#include "study/commands/studies.hpp"
#include "study/commands/study_options.hpp"
#include "study/warp_sets.hpp"
#include "study/warps_report.hpp"

namespace remapc {
namespace {

struct WarpStudyCommand {
  std::vector<std::filesystem::path> sets;
  std::size_t size = 256, stroke_sets = 3;
  std::vector<std::string> materials;  // of the built-in sets; empty: all
  WarpsOptions study;
  OutputOptions output;
};

void run(const WarpStudyCommand& command) {
  require_folder_for_pictures(command.output);
  WarpsOptions options = command.study;
  options.cases = command.sets.empty()
                      ? builtin_warp_cases(command.size, command.stroke_sets, command.materials)
                      : read_warp_cases(command.sets);
  options.pictures = command.output.pictures;
  const WarpsResult result = run_study("warp", options, command.output, study_warps);
  show_report(command.output, warps_report(options, result));
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
  add_output_options(
      app, command.output, command.study.jobs,
      {"Write warp.csv, warp_sensitivity.csv and warp.svg (needs gnuplot) to this folder",
       "Also write three sheets for each set: warp_methods, warp_sampling and warp_strokes_<set>.png",
       "It affects only the measured times", "Print the figures as JSON"});
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
