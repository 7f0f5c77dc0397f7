// `remapc study environments`: how alike converted spheres look under natural light.
#include <algorithm>
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>

#include "build/fit_folder.hpp"
#include "command_line/interruption.hpp"
#include "command_line/progress.hpp"
#include "commands/studies.hpp"
#include "commands/study_environment_options.hpp"
#include "error.hpp"
#include "files.hpp"
#include "fit/gnuplot.hpp"
#include "number_text.hpp"
#include "study/environments_report.hpp"
#include "sweep/image_file.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

const std::filesystem::path kDefaultFitFolder = "fits";

struct EnvironmentsCommand {
  std::vector<std::string> pairs;  // SOURCE:TARGET; empty: the six of default_pairs()
  bool plain = false;
  EnvironmentsOptions study;
  EnvironmentOptions environments;
  std::filesystem::path fit_folder;  // empty: `fits`, where there is such a folder
  std::filesystem::path output;
  bool pictures = false, json = false, quiet = false;
};

ModelPair parse_pair(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || text.find(':', colon + 1) != std::string::npos)
    throw Error(ErrorKind::kUsage, "--pair " + text + ": expected SOURCE:TARGET");
  return {text.substr(0, colon), text.substr(colon + 1)};
}

// The model without Fresnel that stands beside a microfacet model.
std::string plain_model(const std::string& name) {
  return name.find("ward") == std::string::npos ? name + "-plain" : name;
}

std::vector<ModelPair> chosen_pairs(const EnvironmentsCommand& command) {
  std::vector<ModelPair> pairs;
  for (const std::string& text : command.pairs) pairs.push_back(parse_pair(text));
  if (!pairs.empty()) return pairs;
  pairs = default_pairs();
  if (command.plain)
    for (ModelPair& pair : pairs) pair = {plain_model(pair.source), plain_model(pair.target)};
  return pairs;
}

EnvironmentsOptions study_options(const EnvironmentsCommand& command) {
  EnvironmentsOptions options = command.study;
  options.pairs = chosen_pairs(command);
  std::sort(options.alphas.begin(), options.alphas.end());
  options.alphas.erase(std::unique(options.alphas.begin(), options.alphas.end()), options.alphas.end());
  options.environments = read_environments(command.environments);
  if (!command.fit_folder.empty() || std::filesystem::is_directory(kDefaultFitFolder))
    options.fits = load_fits(command.fit_folder.empty() ? kDefaultFitFolder : command.fit_folder);
  if (command.pictures && command.output.empty())
    throw Error(ErrorKind::kUsage, "--pictures: there is no folder for them; expected -o FOLDER");
  if (command.pictures && !options.alphas.empty())
    options.sheet_alpha = options.alphas[options.alphas.size() / 2];
  return options;
}

nlohmann::ordered_json likeness_json(const PictureLikeness& likeness) {
  return {{"rmse_percent", likeness.rmse}, {"ssim", likeness.ssim}, {"energy_error", likeness.energy}};
}

nlohmann::ordered_json report_json(const EnvironmentsOptions& options, const EnvironmentsResult& result) {
  nlohmann::ordered_json json = {{"noise_percent", result.noise},
                                 {"methods", nlohmann::ordered_json::object()}};
  for (const Method method : methods_of(result)) {
    nlohmann::ordered_json entry = likeness_json(mean_likeness(comparisons_of(result, method)));
    entry["pairs"] = nlohmann::ordered_json::array();
    for (std::size_t p = 0; p < options.pairs.size(); ++p) {
      const auto chosen = comparisons_of(result, method, p);
      if (chosen.empty()) continue;
      nlohmann::ordered_json pair = {{"source", options.pairs[p].source},
                                     {"target", options.pairs[p].target}};
      pair.update(likeness_json(mean_likeness(chosen)));
      entry["pairs"].push_back(pair);
    }
    json["methods"][method_name(method)] = entry;
  }
  json["worse_than_copy"] = nlohmann::ordered_json::array();
  for (const WorsePair& worse : worse_than_copy(options, result))
    json["worse_than_copy"].push_back({{"method", method_name(worse.method)},
                                       {"source", options.pairs[worse.pair].source},
                                       {"target", options.pairs[worse.pair].target}});
  json["remarks"] = result.remarks;
  return json;
}

void write_results(const EnvironmentsCommand& command, const EnvironmentsOptions& options,
                   const EnvironmentsResult& result) {
  remap::write_file(command.output / "environments.csv", comparisons_csv(options, result));
  remap::write_file(command.output / "environments_summary.csv", summary_csv(options, result));
  for (std::size_t e = 0; e < result.sheets.size(); ++e)
    write_png(command.output / ("spheres_" + options.environments[e].name + ".png"), result.sheets[e]);
  try {
    remap::write_file(command.output / "environments.svg", run_gnuplot(plot_script(options, result)));
  } catch (const Error& error) {
    std::cerr << "remapc: warning: environments.svg is not drawn: " << error.what() << "\n";
  }
}

void run(const EnvironmentsCommand& command) {
  EnvironmentsOptions options = study_options(command);
  if (!command.output.empty()) remap::create_parent(command.output / "environments.csv");
  remap::watch_interruptions();
  EnvironmentsResult result;
  {
    remap::Progress progress("study environments", progress_steps(options), !command.quiet);
    options.progress = [&] { progress.advance(); };
    options.cancelled = &remap::interruption();
    result = study_environments(options);
  }
  if (!command.output.empty()) write_results(command, options, result);
  if (command.json)
    std::cout << report_json(options, result).dump(2) << "\n";
  else
    std::cout << summary_text(options, result);
}

void add_options(CLI::App& app, EnvironmentsCommand& command) {
  EnvironmentsOptions& study = command.study;
  study.alphas = default_alphas();
  app.add_option("--pair", command.pairs, "SOURCE:TARGET, repeatable; default: six pairs of Mitsuba's models")
      ->allow_extra_args(false);
  app.add_flag("--plain", command.plain, "The default pairs with constant reflectance instead of Fresnel");
  app.add_option("--alphas", study.alphas, "Source widths, comma-separated")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--specular", study.specular, "Of the source, linear")->capture_default_str();
  add_environment_options(app, command.environments);
  app.add_option("--resolution", study.resolution, "Width and height of the pictures")->capture_default_str();
  app.add_option("--samples", study.samples, "Directions a pixel")->capture_default_str();
  app.add_option("--fits", command.fit_folder,
                 "Folder of the fits that `shipped` converts with; default: fits, if there is one");
  app.add_option(
      "-o,--output", command.output,
      "Folder for environments.csv, environments_summary.csv and environments.svg (needs gnuplot)");
  app.add_flag(
      "--pictures", command.pictures,
      "Write spheres_<environment>.png too: the middle alpha, a row a pair; the source, then copy, paper, "
      "natural, shipped, best");
  app.add_flag("--floor", study.floor,
               "Search the parameters of least mean RMSE over these environments too (`best`)");
  app.add_option("--jobs", study.jobs, "Threads; 0: one a core. The figures do not depend on it")
      ->capture_default_str();
  app.add_flag("--json", command.json, "Means as JSON on standard output");
  app.add_flag("--quiet", command.quiet, "No progress");
}

}  // namespace

void add_environments_study(CLI::App& study) {
  CLI::App* command = study.add_subcommand(
      "environments",
      "Render source and converted spheres under environment maps and tell how alike they look, for copying "
      "the parameters, for matches by both objectives, and for the fits as shipped");
  auto options = std::make_shared<EnvironmentsCommand>();
  add_options(*command, *options);
  command->footer(
      "Example:\n  remapc study environments --environment forest.exr --environment studio.exr -o study");
  command->callback([options] { run(*options); });
}

}  // namespace remapc
