// `remap-study dielectrics` matches measured dielectrics and writes tables, a plot and a summary.
#include <algorithm>
#include <functional>
#include <iostream>

#include "remap/error.hpp"
#include "study/commands/studies.hpp"
#include "study/commands/study_options.hpp"
#include "study/dielectrics_study.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

struct MaterialsCommand {
  StudyOptions study;
  double diffuse = 0.3;
  OutputOptions output;
};

constexpr std::size_t kProgressUnits = 1000;

void require_alphas(const MaterialsCommand& command) {
  const std::vector<double>& alphas = command.study.alphas;
  const bool rising =
      std::adjacent_find(alphas.begin(), alphas.end(), std::greater_equal<>()) == alphas.end();
  if (alphas.empty() || !rising || !(alphas.front() >= 0.01 && alphas.back() <= 1.0))
    throw Error(ErrorKind::kUsage, "--alphas: values must increase and lie between 0.01 and 1");
}

// Runs `study` and prints its progress.
template <typename Study>
auto run_with_progress(const MaterialsCommand& command, const std::string& label, const Study& study) {
  require_alphas(command);
  create_folder(command.output);
  remap::Progress progress(label, kProgressUnits, !command.output.quiet);
  StudyOptions options = command.study;
  options.progress = [&](double share) {
    progress.advance_to(static_cast<std::size_t>(share * static_cast<double>(kProgressUnits)));
  };
  return study(*make_builtin_renderer(), options);
}

// Prints the findings and the names of the files.
void show(const MaterialsCommand& command, StudyReport report) {
  const std::vector<std::string> files = write_report(command.output, report);
  report.figures["folder"] = command.output.folder.string();
  report.figures["files"] = files;
  for (const std::string& file : files) report.summary += (command.output.folder / file).string() + "\n";
  std::cout << (command.output.json ? report.figures.dump(2) + "\n" : report.summary);
}

void run_dielectrics(const MaterialsCommand& command) {
  if (!(command.diffuse >= 0.0 && command.diffuse <= 1.0))
    throw Error(ErrorKind::kUsage,
                "--diffuse: " + remap::number_text(command.diffuse) + " is out of range (0 to 1)");
  show(command, dielectrics_report(run_with_progress(
                    command, "dielectrics", [&](const Renderer& renderer, const StudyOptions& options) {
                      return study_dielectrics(renderer, options, command.diffuse);
                    })));
}

constexpr int kMostResolution = 4096;

void add_options(remap::Command& app, MaterialsCommand& command) {
  app.add_option("-o,--output", command.output.folder,
                 "Write tables and plots to this folder; existing files are replaced")
      ->required();
  app.add_option("--alphas", command.study.alphas, "Source alphas in increasing order")->delimiter(',');
  app.add_option("--resolution", command.study.resolution, "Width and height of the pictures in pixels")
      ->range(16, kMostResolution);
  app.add_option("--jobs", command.study.jobs, "Number of threads; 0: one per core");
  app.add_flag("--json", command.output.json, "Print the figures and the summary as JSON");
  app.add_flag("--quiet", command.output.quiet, "Do not show progress");
}

}  // namespace

void add_dielectrics_study(remap::Command& app) {
  remap::Command* command = app.add_subcommand(
      "dielectrics",
      "Match diffuse and specular together in one, two and three stages (figures 8 and 10 of the paper)");
  MaterialsCommand& options = remap::set_work<MaterialsCommand>(*command, run_dielectrics);
  options.study.alphas = {0.1, 0.3, 0.725, 0.75};
  options.study.resolution = 128;
  add_options(*command, options);
  command->add_option("--diffuse", options.diffuse, "Diffuse reflectance of the source");
  command->footer("Example:\n  remap-study dielectrics -o dielectrics");
}

}  // namespace remapc
