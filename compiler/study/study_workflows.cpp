// `remap-study workflows`: measures what conversions from the specular to the metallic workflow lose.
#include <filesystem>

#include "build/fit_folder.hpp"
#include "study/studies.hpp"
#include "study/study_options.hpp"
#include "study/workflows_report.hpp"

namespace remap {
namespace {

// Brighter than usual, because the methods differ most on dark materials.
constexpr double kExposure = 1.7;

struct WorkflowsCommand {
  EnvironmentOptions environments;
  WorkflowsOptions study;
  MaterialSetOptions materials;
  std::size_t family_count = 100000;
  std::filesystem::path fit_folder;  // empty: the default, if it is there
  OutputOptions output;
};

std::vector<NamedConversion> learned_conversions(const std::filesystem::path& folder) {
  std::vector<NamedConversion> learned;
  if (folder.empty()) return learned;
  for (const WorkflowFit& fit : load_fit_folder(folder).workflows)
    if (is_learned(fit.conversion.formula)) learned.push_back({fit.id, fit.conversion});
  return learned;
}

void run(const WorkflowsCommand& command) {
  require_folder_for_pictures(command.output);
  WorkflowsOptions options = command.study;
  MaterialSetOptions materials = command.materials;
  materials.alpha_count = options.alphas.size();
  MaterialSet set = study_materials(materials);
  options.materials = std::move(set.materials);
  options.environments = read_environments(command.environments);
  options.learned = learned_conversions(fit_folder_of(command.fit_folder));
  options.sheets = command.output.pictures;
  if (options.learned.empty())
    set.remarks.emplace_back("the fits contain no network to compare (--fits FOLDER)");
  const WorkflowsResult result = run_study("workflows", options, command.output, study_workflows);
  const std::vector<FamilyLine> family =
      study_family(options.learned, command.family_count, materials.seed, options.jobs);
  show_report(command.output, workflows_report(options, result, family, set.remarks));
}

void add_options(Command& app, WorkflowsCommand& command) {
  WorkflowsOptions& study = command.study;
  study.alphas = {0.05, 0.1, 0.2, 0.4, 0.8};
  command.environments.exposure = kExposure;
  add_environment_options(app, command.environments);
  app.add_option(
      "--materials", command.materials.folder,
      "Folder of the measured materials (ngan_ward.fit, physicallybased.json); default: random materials "
      "only");
  app.add_option("--count", command.materials.group_count, "Number of materials in each of the five groups");
  app.add_option("--alphas", study.alphas, "Alphas, comma-separated; the materials use them in turn")
      ->delimiter(',');
  app.add_option("--family-count", command.family_count,
                 "Number of random metallic materials of each kind for the round trip");
  app.add_option("--seed", command.materials.seed, "Seed of the random materials");
  add_sampling_options(app, study);
  app.add_option("--fits", command.fit_folder,
                 "Folder of fits; their networks are compared, too; default: fits, or the installed ones");
  add_output_options(
      app, command.output, study.jobs,
      {"Write workflows.csv, workflows_summary.csv and workflows.svg (needs gnuplot) to this folder",
       "Also write workflows_<environment>.png: one row for each of two materials per group; columns source "
       "material, then the result of each method",
       "Results do not depend on it", "Print the figures as JSON"});
}

}  // namespace

void add_workflows_study(Command& study) {
  Command* command = study.add_subcommand(
      "workflows",
      "Convert materials from the specular to the metallic workflow by every method and compare pictures "
      "under environment maps; also make round trips of metallic materials");
  WorkflowsCommand& options = set_work<WorkflowsCommand>(*command, run);
  add_options(*command, options);
  command->footer(
      "Example:\n  remap-study workflows --environment forest.exr --environment studio.exr \\\n"
      "    --materials measured -o study");
}

}  // namespace remap
