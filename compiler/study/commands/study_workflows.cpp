// `remap-study workflows`: measures what conversions from the specular to the metallic workflow lose.
#include <filesystem>
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>

#include "manifest/fit_folder.hpp"
#include "study/commands/studies.hpp"
#include "study/commands/study_options.hpp"
#include "study/workflows_report.hpp"
#include "system/files.hpp"

namespace remapc {
namespace {

// Brighter than usual, because the methods differ most on dark materials.
constexpr double kExposure = 1.7;

struct WorkflowsCommand {
  EnvironmentOptions environments;
  WorkflowsOptions study;
  MaterialSetOptions materials;
  std::size_t family_count = 100000;
  OutputOptions output;
};

std::vector<NamedConversion> learned_conversions(const std::filesystem::path& folder) {
  std::vector<NamedConversion> learned;
  if (folder.empty()) return learned;
  for (const remap::WorkflowFit& fit : load_fit_folder(folder).analytic)
    if (is_learned(fit.conversion.formula)) learned.push_back({fit.id, fit.conversion});
  return learned;
}

nlohmann::ordered_json figures_json(const WorkflowFigures& figures) {
  return {{"rmse_percent", figures.rmse},
          {"ssim", figures.ssim},
          {"worst_ssim", figures.worst_ssim},
          {"headlight_rmse_percent", figures.headlight_rmse},
          {"headlight_ssim", figures.headlight_ssim}};
}

nlohmann::ordered_json report_json(const WorkflowsOptions& options, const WorkflowsResult& result,
                                   const std::vector<FamilyLine>& family,
                                   const std::vector<std::string>& remarks) {
  nlohmann::ordered_json json = {{"materials", options.materials.size()}};
  for (const WorkflowComparison& comparison : result.comparisons)
    for (std::size_t m = 0; m < comparison.methods.size(); ++m) {
      nlohmann::ordered_json entry = figures_json(figures_of(options, comparison, m));
      for (const MaterialGroup group : groups_of(options))
        entry["groups"][group_name(group)] = figures_json(figures_of(options, comparison, m, group));
      json[comparison.convention][comparison.methods[m]] = entry;
    }
  for (const FamilyLine& line : family)
    for (std::size_t kind = 0; kind < kFamilyKinds; ++kind)
      json["family"][line.method][family_name(static_cast<FamilyKind>(kind))] = {
          {"metallic_rms", line.errors[kind].metallic}, {"base_color_rms", line.errors[kind].base_color}};
  json["remarks"] = remarks;
  return json;
}

void write_results(const std::filesystem::path& folder, const WorkflowsOptions& options,
                   const WorkflowsResult& result) {
  remap::write_file(folder / "workflows.csv", workflow_materials_csv(options, result));
  remap::write_file(folder / "workflows_summary.csv", workflow_summary_csv(options, result));
  write_sheets(folder, "workflows", options.environments, result.sheets);
  write_plot(folder / "workflows.svg", workflows_plot_script(options, result));
}

std::string sheet_text(const WorkflowsResult& result) {
  if (result.sheets.empty()) return "";
  std::string text = "\nRows of the contact sheets: ";
  for (std::size_t i = 0; i < result.sheet_materials.size(); ++i)
    text += (i == 0 ? "" : ", ") + result.sheet_materials[i];
  return text + ".\nColumns: the source material, then the methods of the first table.\n";
}

void run(const WorkflowsCommand& command) {
  require_folder_for_pictures(command.output);
  WorkflowsOptions options = command.study;
  MaterialSetOptions materials = command.materials;
  materials.alpha_count = options.alphas.size();
  MaterialSet set = study_materials(materials);
  options.materials = std::move(set.materials);
  options.environments = read_environments(command.environments);
  options.learned = learned_conversions(fit_folder_of(command.output));
  options.sheets = command.output.pictures;
  if (options.learned.empty())
    set.remarks.emplace_back("the fits contain no network to compare (--fits FOLDER)");
  const std::filesystem::path& folder = command.output.folder;
  if (!folder.empty()) remap::create_parent(folder / "workflows.csv");
  const WorkflowsResult result = run_study("workflows", options, command.output.quiet, study_workflows);
  const std::vector<FamilyLine> family =
      study_family(options.learned, command.family_count, materials.seed, options.jobs);
  if (!folder.empty()) write_results(folder, options, result);
  if (command.output.json) {
    std::cout << report_json(options, result, family, set.remarks).dump(2) << "\n";
    return;
  }
  std::cout << workflows_text(options, result, family) << sheet_text(result);
  for (const std::string& remark : set.remarks) std::cout << "Note: " << remark << ".\n";
}

void add_options(remap::Command& app, WorkflowsCommand& command) {
  WorkflowsOptions& study = command.study;
  study.alphas = {0.05, 0.1, 0.2, 0.4, 0.8};
  command.environments.exposure = kExposure;
  add_environment_options(app, command.environments);
  app.add_option(
      "--materials", command.materials.folder,
      "Folder of the measured materials (ngan_ward.fit, physicallybased.json); default: random materials "
      "only");
  app.add_option("--count", command.materials.group_count, "Number of materials in each of the five groups")
      ->capture_default_str();
  app.add_option("--alphas", study.alphas, "Alphas, comma-separated; the materials use them in turn")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--family-count", command.family_count,
                 "Number of random metallic materials of each kind for the round trip")
      ->capture_default_str();
  app.add_option("--seed", command.materials.seed, "Seed of the random materials")->capture_default_str();
  add_output_options(
      app, command.output, study,
      {"Folder of fits; their networks are compared, too",
       "Write workflows.csv, workflows_summary.csv and workflows.svg (needs gnuplot) to this folder",
       "Also write workflows_<environment>.png: one row for each of two materials per group; columns source "
       "material, then the result of each method",
       "Print the figures as JSON"});
}

}  // namespace

void add_workflows_study(remap::Command& study) {
  remap::Command* command = study.add_subcommand(
      "workflows",
      "Convert materials from the specular to the metallic workflow by every method and compare pictures "
      "under environment maps; also convert metallic materials there and back");
  auto options = std::make_shared<WorkflowsCommand>();
  add_options(*command, *options);
  command->footer(
      "Example:\n  remap-study workflows --environment forest.exr --environment studio.exr \\\n"
      "    --materials measured -o study");
  command->callback([options] { run(*options); });
}

}  // namespace remapc
