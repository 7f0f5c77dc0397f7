// `remap-study conductors` and `remap-study dielectrics`: match measured materials and write tables, plots
// and a summary.
#include <algorithm>
#include <functional>
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>

#include "command_line/progress.hpp"
#include "remap/error.hpp"
#include "study/commands/studies.hpp"
#include "study/commands/study_options.hpp"
#include "study/conductors_study.hpp"
#include "study/dielectrics_study.hpp"
#include "system/files.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

struct MaterialsCommand {
  std::filesystem::path output;
  StudyOptions study;
  double diffuse = 0.3;
  bool json = false, quiet = false;
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
  remap::create_parent(command.output / "table.csv");
  remap::Progress progress(label, kProgressUnits, !command.quiet);
  StudyOptions options = command.study;
  options.progress = [&](double share) {
    progress.advance_to(static_cast<std::size_t>(share * static_cast<double>(kProgressUnits)));
  };
  return study(*make_builtin_renderer(), options);
}

void report(const MaterialsCommand& command, const std::vector<std::string>& words,
            const std::vector<std::string>& files, nlohmann::ordered_json figures) {
  if (command.json) {
    figures["words"] = words;
    figures["folder"] = command.output.string();
    figures["files"] = files;
    std::cout << figures.dump(2) << "\n";
    return;
  }
  for (const std::string& sentence : words) std::cout << sentence << "\n";
  for (const std::string& file : files) std::cout << (command.output / file).string() << "\n";
}

nlohmann::ordered_json conductors_json(const ConductorsStudy& study) {
  nlohmann::ordered_json curves = nlohmann::ordered_json::array();
  for (const ConductorCurve& curve : study.curves)
    curves.push_back({{"alpha", curve.alpha},
                      {"ok", curve.ok},
                      {"clamped", curve.clamped},
                      {"other", curve.other},
                      {"line_deviation", curve.line_deviation},
                      {"limit_f0", curve.limit_f0},
                      {"clamped_alpha_shift", curve.clamped_alpha_shift}});
  double mean = 0.0, largest = 0.0;
  for (const FresnelDifference& item : study.fresnel) {
    mean += item.error / static_cast<double>(study.fresnel.size());
    largest = std::max(largest, item.error);
  }
  return {{"curves", curves},
          {"round_trip",
           {{"rows", study.round_trip.rows},
            {"slope", study.round_trip.slope},
            {"offset", study.round_trip.offset},
            {"f0_deviation", study.round_trip.f0_deviation},
            {"alpha_deviation", study.round_trip.alpha_deviation}}},
          {"schlick_error", {{"mean", mean}, {"max", largest}}},
          {"exact_specular_shift", study.exact_specular_shift}};
}

nlohmann::ordered_json dielectrics_json(const DielectricsStudy& study) {
  nlohmann::ordered_json curves = nlohmann::ordered_json::array();
  for (const DielectricCurve& curve : study.curves)
    curves.push_back({{"stages", curve.stages},
                      {"alpha", curve.alpha},
                      {"second_difference", curve.second_difference},
                      {"largest_step", curve.largest_step},
                      {"largest_step_ior", curve.step_ior},
                      {"mean_error", curve.mean_error},
                      {"max_error", curve.worst_error},
                      {"unstable", curve.unstable},
                      {"clamped", curve.clamped},
                      {"least_highlight", curve.least_highlight},
                      {"jumps", curve.jumps()}});
  std::size_t lost = 0, jumping = 0;
  for (const GuessTrial& trial : study.trials) {
    lost += trial.lost > 0 ? 1 : 0;
    jumping += trial.jumps > 0 ? 1 : 0;
  }
  return {{"curves", curves},
          {"guesses", {{"curves", study.trials.size()}, {"lost", lost}, {"jumping", jumping}}},
          {"three_stages_error_gain", study.error_gain},
          {"three_stages_specular_move", study.worst_difference}};
}

void run_conductors(const MaterialsCommand& command) {
  const ConductorsStudy study =
      run_with_progress(command, "conductors", [&](const Renderer& renderer, const StudyOptions& options) {
        return study_conductors(renderer, options);
      });
  std::vector<std::string> files = write_conductors(study, command.output);
  if (write_plot(command.output / "figure6_7.svg", conductors_plot_script(study)))
    files.push_back("figure6_7.svg");
  report(command, conductors_words(study), files, conductors_json(study));
}

void run_dielectrics(const MaterialsCommand& command) {
  if (!(command.diffuse >= 0.0 && command.diffuse <= 1.0))
    throw Error(ErrorKind::kUsage,
                "--diffuse: " + remap::number_text(command.diffuse) + " is out of range (0 to 1)");
  const DielectricsStudy study =
      run_with_progress(command, "dielectrics", [&](const Renderer& renderer, const StudyOptions& options) {
        return study_dielectrics(renderer, options, command.diffuse);
      });
  std::vector<std::string> files = write_dielectrics(study, command.output);
  if (write_plot(command.output / "figure8_10.svg", dielectrics_plot_script(study)))
    files.push_back("figure8_10.svg");
  report(command, dielectrics_words(study), files, dielectrics_json(study));
}

constexpr int kMostResolution = 4096;

void add_options(remap::Command& app, MaterialsCommand& command) {
  app.add_option("-o,--output", command.output,
                 "Write tables and plots to this folder; existing files are replaced")
      ->required();
  app.add_option("--alphas", command.study.alphas, "Source alphas in increasing order")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--resolution", command.study.resolution, "Width and height of the pictures in pixels")
      ->range(16, kMostResolution)
      ->capture_default_str();
  app.add_option("--jobs", command.study.jobs, "Number of threads; 0: one per core")->capture_default_str();
  app.add_flag("--json", command.json, "Print the figures and the summary as JSON");
  app.add_flag("--quiet", command.quiet, "Do not show progress");
}

}  // namespace

void add_conductors_study(remap::Command& app) {
  remap::Command* command = app.add_subcommand(
      "conductors",
      "Convert measured metals from Ashikhmin-Shirley to Ward and back (figures 6 and 7 of the paper)");
  auto options = std::make_shared<MaterialsCommand>();
  options->study.alphas = {0.05, 0.1, 0.2, 0.3, 0.5};
  options->study.resolution = 256;
  add_options(*command, *options);
  command->footer("Example:\n  remap-study conductors -o conductors");
  command->callback([options] { run_conductors(*options); });
}

void add_dielectrics_study(remap::Command& app) {
  remap::Command* command = app.add_subcommand(
      "dielectrics",
      "Match diffuse and specular together in one, two and three stages (figures 8 and 10 of the paper)");
  auto options = std::make_shared<MaterialsCommand>();
  options->study.alphas = {0.1, 0.3, 0.725, 0.75};
  options->study.resolution = 128;
  add_options(*command, *options);
  command->add_option("--diffuse", options->diffuse, "Diffuse reflectance of the source")
      ->capture_default_str();
  command->footer("Example:\n  remap-study dielectrics -o dielectrics");
  command->callback([options] { run_dielectrics(*options); });
}

}  // namespace remapc
