// This file is `remap-study environments`. It compares pictures of source and converted spheres under
// environment maps.
#include <algorithm>

#include "build/fit_folder.hpp"
#include "core/errors.hpp"
#include "study/environments.hpp"
#include "study/study_options.hpp"

namespace remap {
namespace {

struct EnvironmentsCommand {
  std::vector<std::string> pairs;  // SOURCE:TARGET; if empty, the six pairs of default_pairs()
  bool plain = false;
  EnvironmentsOptions study;
  StudyOptions shared;
};

StudyPair parse_pair(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || text.find(':', colon + 1) != std::string::npos)
    throw usage_error("--pair: '" + text + "' is not a pair (use SOURCE:TARGET)");
  return {text.substr(0, colon), text.substr(colon + 1)};
}

// Returns the variant of a microfacet model that has a constant reflectance instead of Fresnel. Ward has no
// Fresnel term, so its name stays.
std::string plain_model(const std::string& name) {
  return name.find("ward") == std::string::npos ? name + "-plain" : name;
}

std::vector<StudyPair> chosen_pairs(const EnvironmentsCommand& command) {
  std::vector<StudyPair> pairs;
  for (const std::string& text : command.pairs) pairs.push_back(parse_pair(text));
  if (!pairs.empty()) return pairs;
  pairs = default_pairs();
  if (command.plain)
    for (StudyPair& pair : pairs) pair = {plain_model(pair.source), plain_model(pair.target)};
  return pairs;
}

EnvironmentsOptions study_options(const EnvironmentsCommand& command) {
  EnvironmentsOptions options = command.study;
  options.pairs = chosen_pairs(command);
  std::ranges::sort(options.alphas);
  options.alphas.erase(std::unique(options.alphas.begin(), options.alphas.end()), options.alphas.end());
  options.environments = read_environments(command.shared);
  if (const auto folder = fit_folder_of(command.shared); !folder.empty()) options.fits = load_fits(folder);
  if (command.shared.pictures && !options.alphas.empty())
    options.sheet_alpha = options.alphas[options.alphas.size() / 2];
  return options;
}

void run(const EnvironmentsCommand& command) {
  EnvironmentsOptions options = study_options(command);
  std::vector<Image> sheets;
  const std::vector<EnvironmentComparison> comparisons =
      run_study("environments", options, command.shared,
                [&](const EnvironmentsOptions& study) { return study_environments(study, &sheets); });
  write_results(command.shared, "environments", environments_csv(options, comparisons));
  write_sheets(command.shared, "spheres", options.environments, sheets);
}

void add_options(Command& app, EnvironmentsCommand& command) {
  EnvironmentsOptions& study = command.study;
  study.alphas = default_alphas();
  app.add_option("--pair", command.pairs, "SOURCE:TARGET, repeatable; default: six pairs of Mitsuba models")
      ->allow_extra_args(false);
  app.add_flag("--plain", command.plain, "Use the default pairs without Fresnel (constant reflectance)");
  app.add_option("--alphas", study.alphas, "Source alphas, comma-separated")->delimiter(',');
  app.add_option("--specular", study.specular, "Specular reflectance of the source, linear");
  app.add_option("--diffuse", study.diffuse, "Diffuse reflectance of source and target, linear");
  add_environment_options(app, command.shared);
  app.add_flag("--least-error", study.least_error,
               "Also search for the parameters of least mean RMSE under these environments (`best`)");
  add_sampling_options(app, study);
  app.add_option("--fits FOLDER", command.shared.fit_folder,
                 "Folder of the fits for the method `shipped`; default: fits, or the installed ones");
  add_output_options(
      app, command.shared, study.jobs,
      "Write environments.csv to this folder, its settings to environments.csv.json, instead of printing "
      "both",
      "Also write spheres_<environment>.png at the middle alpha: one row for each pair; columns source, "
      "copy, paper, natural-1, natural-2, shipped, best");
}

}  // namespace

void add_environments_study(Command& study) {
  Command* command = study.add_subcommand(
      "environments",
      "Compare pictures of source and converted spheres under environment maps, for copied parameters, for "
      "matches by every objective and for the shipped fits");
  EnvironmentsCommand& options = set_work<EnvironmentsCommand>(*command, run);
  add_options(*command, options);
  command->footer(
      "Example:\n  remap-study environments --environment forest.exr --environment studio.exr \\\n    -o "
      "study && scripts/studies/summarize study");
}

}  // namespace remap
