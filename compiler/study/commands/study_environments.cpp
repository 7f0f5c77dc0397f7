// `remap-study environments`: compares pictures of source and converted spheres under environment maps.
#include <algorithm>
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>

#include "manifest/fit_folder.hpp"
#include "remap/error.hpp"
#include "study/commands/studies.hpp"
#include "study/commands/study_options.hpp"
#include "study/environments_report.hpp"
#include "system/files.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

struct EnvironmentsCommand {
  std::vector<std::string> pairs;  // SOURCE:TARGET; empty: the six of default_pairs()
  bool plain = false;
  EnvironmentsOptions study;
  EnvironmentOptions environments;
  OutputOptions output;
};

ModelPair parse_pair(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || text.find(':', colon + 1) != std::string::npos)
    throw Error(ErrorKind::kUsage, "--pair: '" + text + "' is not a pair (use SOURCE:TARGET)");
  return {text.substr(0, colon), text.substr(colon + 1)};
}

// The variant of a microfacet model with constant reflectance in place of Fresnel. Ward has no Fresnel term.
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
  if (const auto folder = fit_folder_of(command.output); !folder.empty()) options.fits = load_fits(folder);
  require_folder_for_pictures(command.output);
  if (command.output.pictures && !options.alphas.empty())
    options.sheet_alpha = options.alphas[options.alphas.size() / 2];
  return options;
}

nlohmann::ordered_json similarity_json(const PictureSimilarity& image_similarity) {
  return {{"rmse_percent", image_similarity.rmse},
          {"ssim", image_similarity.ssim},
          {"energy_error", image_similarity.energy}};
}

nlohmann::ordered_json report_json(const EnvironmentsOptions& options, const EnvironmentsResult& result) {
  nlohmann::ordered_json json = {{"noise_percent", result.noise},
                                 {"methods", nlohmann::ordered_json::object()}};
  for (const Method method : methods_of(result)) {
    nlohmann::ordered_json entry = similarity_json(mean_similarity(comparisons_of(result, method)));
    entry["pairs"] = nlohmann::ordered_json::array();
    for (std::size_t p = 0; p < options.pairs.size(); ++p) {
      const auto chosen = comparisons_of(result, method, p);
      if (chosen.empty()) continue;
      nlohmann::ordered_json pair = {{"source", options.pairs[p].source},
                                     {"target", options.pairs[p].target}};
      pair.update(similarity_json(mean_similarity(chosen)));
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

void write_results(const std::filesystem::path& folder, const EnvironmentsOptions& options,
                   const EnvironmentsResult& result) {
  remap::write_file(folder / "environments.csv", comparisons_csv(options, result));
  remap::write_file(folder / "environments_summary.csv", summary_csv(options, result));
  write_sheets(folder, "spheres", options.environments, result.sheets);
  write_plot(folder / "environments.svg", plot_script(options, result));
}

void run(const EnvironmentsCommand& command) {
  EnvironmentsOptions options = study_options(command);
  const std::filesystem::path& folder = command.output.folder;
  if (!folder.empty()) remap::create_parent(folder / "environments.csv");
  const EnvironmentsResult result =
      run_study("environments", options, command.output.quiet, study_environments);
  if (!folder.empty()) write_results(folder, options, result);
  if (command.output.json)
    std::cout << report_json(options, result).dump(2) << "\n";
  else
    std::cout << summary_text(options, result);
}

void add_options(remap::Command& app, EnvironmentsCommand& command) {
  EnvironmentsOptions& study = command.study;
  study.alphas = default_alphas();
  app.add_option("--pair", command.pairs, "SOURCE:TARGET, repeatable; default: six pairs of Mitsuba models")
      ->allow_extra_args(false);
  app.add_flag("--plain", command.plain, "Use the default pairs without Fresnel (constant reflectance)");
  app.add_option("--alphas", study.alphas, "Source alphas, comma-separated")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--specular", study.specular, "Specular reflectance of the source, linear")
      ->capture_default_str();
  add_environment_options(app, command.environments);
  app.add_flag("--least-error", study.least_error,
               "Also search for the parameters of least mean RMSE under these environments (`best`)");
  add_output_options(
      app, command.output, study,
      {"Folder of the fits for the method `shipped`",
       "Write environments.csv, environments_summary.csv and environments.svg (needs gnuplot) to this folder",
       "Also write spheres_<environment>.png at the middle alpha: one row for each pair; columns source, "
       "copy, paper, natural, shipped, best",
       "Print the means as JSON"});
}

}  // namespace

void add_environments_study(remap::Command& study) {
  remap::Command* command = study.add_subcommand(
      "environments",
      "Compare pictures of source and converted spheres under environment maps, for copied parameters, for "
      "matches by both objectives and for the shipped fits");
  auto options = std::make_shared<EnvironmentsCommand>();
  add_options(*command, *options);
  command->footer(
      "Example:\n  remap-study environments --environment forest.exr --environment studio.exr \\\n    -o "
      "study");
  command->callback([options] { run(*options); });
}

}  // namespace remapc
