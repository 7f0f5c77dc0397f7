// This file is `remap-study reach`. It measures how much closer the target could come to the source than
// converters bring it.
#include <algorithm>
#include <memory>

#include "build/fit_folder.hpp"
#include "core/errors.hpp"
#include "study/reach.hpp"
#include "study/study_options.hpp"
#include "table/table.hpp"
#include "worker/renderer_set.hpp"

namespace remap {
namespace {

struct ReachCommand {
  std::vector<std::string> ids;
  ReachOptions study;
  bool records = false;
  StudyOptions shared;
  RendererOptions renderers;
};

bool is_builtin(const std::string& model) { return model.rfind("mitsuba/", 0) == 0; }

Range sampled_speculars(const std::filesystem::path& table) {
  const std::vector<TableRow> rows = read_table(table).rows;
  const auto [least, most] = std::ranges::minmax_element(rows, {}, &TableRow::specular1);
  return {least->specular1, most->specular1};
}

// Returns the fits that the user requested. Without a request, returns all fits between built-in models that
// were matched by pictures.
std::vector<Fit> chosen_fits(const ReachCommand& command, const std::filesystem::path& folder) {
  std::vector<Fit> chosen;
  for (Fit& fit : load_fits(folder)) {
    const bool is_asked_for = std::ranges::find(command.ids, fit.id) != command.ids.end();
    const bool is_compared =
        is_builtin(fit.source.model) && is_builtin(fit.target.model) && fit.image_error.has_value();
    if (command.ids.empty() ? is_compared : is_asked_for) chosen.push_back(std::move(fit));
  }
  if (chosen.empty() || chosen.size() < command.ids.size())
    throw usage_error("reach: " + folder.string() +
                      " does not contain all of these fits (check the ids, or give --fits FOLDER)");
  return chosen;
}

void record(const std::filesystem::path& folder, const ReachOptions& options,
            const std::vector<std::vector<ReachedMaterial>>& result) {
  ReachRecords records = read_reach(folder);
  for (std::size_t f = 0; f < result.size(); ++f) {
    const std::string& id = options.fits[f].id;
    const ReachedMaterial& worst = *std::ranges::max_element(result[f], {}, &ReachedMaterial::excess);
    double sum = 0.0;
    for (const ReachedMaterial& material : result[f]) sum += material.excess();
    records[id] = {file_sha256(folder / (id + ".json")),
                   result[f].size(),
                   sum / static_cast<double>(result[f].size()),
                   worst.excess(),
                   worst.alpha,
                   worst.specular};
  }
  write_reach(folder, records);
}

void run(const ReachCommand& command) {
  ReachOptions options = command.study;
  const std::filesystem::path folder = fit_folder_of(command.shared);
  if (folder.empty()) throw usage_error("--fits: no folder `fits` here (give --fits FOLDER)");
  options.fits = chosen_fits(command, folder);
  for (const Fit& fit : options.fits)
    options.speculars.push_back(sampled_speculars(folder / "tables" / (fit.id + ".csv")));
  const std::unique_ptr<RendererSet> renderer = make_renderers(command.renderers);
  const std::vector<std::vector<ReachedMaterial>> result =
      run_study("reach", options, command.shared,
                [&](const ReachOptions& study) { return study_reach(*renderer, study); });
  if (command.records) record(folder, options, result);
  write_results(command.shared, "reach", reach_csv(options, result));
}

}  // namespace

void add_reach_study(Command& app) {
  Command* command = app.add_subcommand(
      "reach",
      "Compare converted materials with the best that the target can do, over the whole range of the source");
  ReachCommand& options = set_work<ReachCommand>(*command, run);
  command->add_option("ID", options.ids, "Fits; default: all of the folder between Mitsuba models");
  command->add_option("--fits FOLDER", options.shared.fit_folder,
                      "Folder of the fits; default: fits, or the installed ones");
  command->add_flag(
      "--record", options.records,
      "Also write the mean and the largest excess to reach.csv in the folder of fits, for remapc build");
  command->add_option("--materials", options.study.materials, "Source alphas, and speculars of each")
      ->range(2, 256);
  command->add_option("--resolution", options.study.resolution, "Width and height of the pictures in pixels")
      ->range(16, 1024);
  add_output_options(
      *command, options.shared, options.study.jobs,
      "Write reach.csv to this folder, its settings to reach.csv.json, instead of printing both");
  add_renderer_options(*command, options.renderers);
  command->footer(
      "Example:\n  remap-study reach mitsuba_as_to_mitsuba_ward --materials 16 \\\n    | "
      "scripts/studies/summarize");
}

}  // namespace remap
