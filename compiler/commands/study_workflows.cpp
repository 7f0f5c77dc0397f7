// `remapc study workflows`: what conversions from the specular to the metallic workflow lose.
#include <filesystem>
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
#include "study/workflows_report.hpp"
#include "sweep/image_file.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

const std::filesystem::path kDefaultFitFolder = "fits";
// Brighter than mid grey needs: dark materials, on which methods differ most, are seen.
constexpr double kExposure = 1.7;

struct WorkflowsCommand {
  EnvironmentOptions environments;
  WorkflowsOptions study;
  MaterialSetOptions materials;
  std::filesystem::path fit_folder;  // empty: `fits`, where there is such a folder
  std::size_t family_count = 100000;
  std::filesystem::path output;
  bool pictures = false, json = false, quiet = false;
};

std::vector<NamedConversion> learned_conversions(const std::filesystem::path& folder) {
  std::vector<NamedConversion> learned;
  if (folder.empty() && !std::filesystem::is_directory(kDefaultFitFolder)) return learned;
  for (const remap::AnalyticFit& fit : load_fit_folder(folder.empty() ? kDefaultFitFolder : folder).analytic)
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

void write_results(const WorkflowsCommand& command, const WorkflowsOptions& options,
                   const WorkflowsResult& result) {
  remap::write_file(command.output / "workflows.csv", workflow_materials_csv(options, result));
  remap::write_file(command.output / "workflows_summary.csv", workflow_summary_csv(options, result));
  for (std::size_t e = 0; e < result.sheets.size(); ++e)
    write_png(command.output / ("workflows_" + options.environments[e].name + ".png"), result.sheets[e]);
  try {
    remap::write_file(command.output / "workflows.svg", run_gnuplot(workflows_plot_script(options, result)));
  } catch (const Error& error) {
    std::cerr << "remapc: warning: workflows.svg is not drawn: " << error.what() << "\n";
  }
}

std::string sheet_text(const WorkflowsResult& result) {
  if (result.sheets.empty()) return "";
  std::string text = "\nRows of the contact sheets: ";
  for (std::size_t i = 0; i < result.sheet_materials.size(); ++i)
    text += (i == 0 ? "" : ", ") + result.sheet_materials[i];
  return text + ".\nColumns: the material, then the methods of the first table.\n";
}

void run(const WorkflowsCommand& command) {
  if (command.pictures && command.output.empty())
    throw Error(ErrorKind::kUsage, "--pictures: there is no folder for them; expected -o FOLDER");
  WorkflowsOptions options = command.study;
  MaterialSetOptions materials = command.materials;
  materials.alpha_count = options.alphas.size();
  MaterialSet set = study_materials(materials);
  options.materials = std::move(set.materials);
  options.environments = read_environments(command.environments);
  options.learned = learned_conversions(command.fit_folder);
  options.sheets = command.pictures;
  if (options.learned.empty()) set.remarks.emplace_back("no network among the fits (--fits FOLDER)");
  if (!command.output.empty()) remap::create_parent(command.output / "workflows.csv");
  remap::watch_interruptions();
  WorkflowsResult result;
  {
    remap::Progress progress("study workflows", progress_steps(options), !command.quiet);
    options.progress = [&] { progress.advance(); };
    options.cancelled = &remap::interruption();
    result = study_workflows(options);
  }
  const std::vector<FamilyLine> family =
      study_family(options.learned, command.family_count, materials.seed, options.jobs);
  if (!command.output.empty()) write_results(command, options, result);
  if (command.json) {
    std::cout << report_json(options, result, family, set.remarks).dump(2) << "\n";
    return;
  }
  std::cout << workflows_text(options, result, family) << sheet_text(result);
  for (const std::string& remark : set.remarks) std::cout << "Left out: " << remark << ".\n";
}

void add_options(CLI::App& app, WorkflowsCommand& command) {
  WorkflowsOptions& study = command.study;
  study.alphas = {0.05, 0.1, 0.2, 0.4, 0.8};
  command.environments.exposure = kExposure;
  add_environment_options(app, command.environments);
  app.add_option(
      "--materials", command.materials.folder,
      "Folder with ngan_ward.fit and physicallybased.json, the measured materials; without it there "
      "are random ones only");
  app.add_option("--count", command.materials.group_count, "Materials of each of the five groups")
      ->capture_default_str();
  app.add_option("--alphas", study.alphas, "Widths, comma-separated; materials take them in turn")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--family-count", command.family_count,
                 "Random metallic materials of each kind that go there and back")
      ->capture_default_str();
  app.add_option("--seed", command.materials.seed, "Of all random materials")->capture_default_str();
  app.add_option("--resolution", study.resolution, "Width and height of the pictures")->capture_default_str();
  app.add_option("--samples", study.samples, "Directions a pixel")->capture_default_str();
  app.add_option("--fits", command.fit_folder,
                 "Folder of fits whose networks are compared too; default: fits, if there is one");
  app.add_option("-o,--output", command.output,
                 "Folder for workflows.csv, workflows_summary.csv and workflows.svg (needs gnuplot)");
  app.add_flag(
      "--pictures", command.pictures,
      "Write workflows_<environment>.png too: a row a material, two of each group; the material, then "
      "what each method makes of it");
  app.add_option("--jobs", study.jobs, "Threads; 0: one a core. The figures do not depend on it")
      ->capture_default_str();
  app.add_flag("--json", command.json, "Figures as JSON on standard output");
  app.add_flag("--quiet", command.quiet, "No progress");
}

}  // namespace

void add_workflows_study(CLI::App& study) {
  CLI::App* command = study.add_subcommand(
      "workflows",
      "Convert materials of the specular workflow to the metallic one by every method, render both under "
      "environment maps and tell how alike they look; and metallic materials there and back");
  auto options = std::make_shared<WorkflowsCommand>();
  add_options(*command, *options);
  command->footer(
      "Example:\n  remapc study workflows --environment forest.exr --environment studio.exr --materials "
      "measured -o study");
  command->callback([options] { run(*options); });
}

}  // namespace remapc
