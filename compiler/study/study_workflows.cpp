// This file is `remap-study workflows`. It measures what is lost in conversions from the specular to the
// metallic workflow.
#include <filesystem>

#include "build/fit_folder.hpp"
#include "core/input_file.hpp"
#include "study/study_options.hpp"
#include "study/workflows.hpp"

namespace remap {
namespace {

// This is brighter than usual, because the methods differ most on dark materials.
constexpr double kExposure = 1.7;

struct WorkflowsCommand {
  std::filesystem::path materials;
  WorkflowsOptions study;
  std::size_t family_count = 100000;
  std::uint64_t seed = 1;
  StudyOptions shared;
};

void run(const WorkflowsCommand& command) {
  WorkflowsOptions options = command.study;
  read_materials(read_file(command.materials), command.materials.string(), &options);
  options.environments = read_environments(command.shared);
  if (const auto folder = fit_folder_of(command.shared); !folder.empty())
    for (const WorkflowFit& fit : load_fit_folder(folder).workflows)
      if (is_learned(fit.conversion.formula)) options.learned.push_back(fit);
  std::vector<Image> sheets;
  const std::vector<WorkflowComparison> comparisons =
      run_study("workflows", options, command.shared, [&](const WorkflowsOptions& study) {
        return study_workflows(study, command.shared.pictures ? &sheets : nullptr);
      });
  write_results(command.shared, "workflows", workflows_csv(options, comparisons));
  if (command.shared.folder.empty()) return;
  const std::vector<RoundTripErrors> trips =
      study_round_trips(options.learned, command.family_count, command.seed, options.jobs);
  write_results(command.shared, "workflows_round_trips",
                round_trips_csv(trips, command.family_count, command.seed));
  write_sheets(command.shared, "workflows", options.environments, sheets);
}

}  // namespace

void add_workflows_study(Command& study) {
  Command* command = study.add_subcommand(
      "workflows",
      "Convert materials from the specular to the metallic workflow by every method and compare pictures "
      "under environment maps; with -o, also make round trips of metallic materials");
  WorkflowsCommand& options = set_work<WorkflowsCommand>(*command, run);
  options.shared.exposure = kExposure;
  command
      ->add_option("MATERIALS", options.materials,
                   "CSV file of materials, as scripts/studies/materials writes it")
      ->required();
  add_environment_options(*command, options.shared);
  command
      ->add_option("--family-count", options.family_count,
                   "Number of random metallic materials of each kind for the round trip")
      ->positive();
  command->add_option("--seed", options.seed, "Seed of these materials");
  add_sampling_options(*command, options.study);
  command->add_option(
      "--fits FOLDER", options.shared.fit_folder,
      "Folder of fits; their networks are compared, too; default: fits, or the installed ones");
  add_output_options(
      *command, options.shared, options.study.jobs,
      "Write workflows.csv and workflows_round_trips.csv to this folder, their settings to files .csv.json; "
      "without, print workflows.csv",
      "Also write workflows_<environment>.png: one row for each of two materials per group; columns source "
      "material, then the result of each method");
  command->footer(
      "Example:\n  scripts/studies/materials > materials.csv\n"
      "  remap-study workflows materials.csv -o study\n"
      "  scripts/studies/summarize study");
}

}  // namespace remap
