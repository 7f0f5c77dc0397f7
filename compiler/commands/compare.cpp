// This file is `remapc compare`, which prints the errors of fits and of common formulas on one table.
#include <algorithm>
#include <iostream>
#include <optional>

#include "build/fit_folder.hpp"
#include "commands/candidate_table.hpp"
#include "commands/commands.hpp"
#include "commands/option_readers.hpp"
#include "core/errors.hpp"
#include "core/input_file.hpp"
#include "core/json.hpp"
#include "core/number_text.hpp"
#include "fit/baselines.hpp"
#include "report/fit_plot.hpp"
#include "table/regression.hpp"

namespace remap {
namespace {

struct CompareOptions {
  TableInput table;
  std::vector<std::string> fits;
  std::filesystem::path fit_folder;
  bool json = false;
};

struct NamedFit {
  Fit fit;
  std::string file;
};

// An Entry holds the errors of a fit or a formula on the rows of the table.
struct Entry {
  CandidateRecord candidate;
  Json origin;          // where it comes from, for JSON
  std::string why_not;  // why a formula does not apply, or empty
};

bool converts(const Fit& fit, const Table& table) {
  return (table.source.model.empty() || fit.source.model == table.source.model) &&
         (table.target.model.empty() || fit.target.model == table.target.model);
}

std::vector<NamedFit> chosen_fits(const CompareOptions& options, const Table& table) {
  std::vector<NamedFit> fits;
  const auto file_of = [&](const std::string& id) { return (options.fit_folder / (id + ".json")).string(); };
  for (const std::string& name : options.fits) {
    const Fit fit = find_fit(name, options.fit_folder);
    if (!converts(fit, table))
      throw input_error(name + ": converts " + fit.source.model + " to " + fit.target.model +
                        ", but the table is for " + table.source.model + " to " + table.target.model +
                        " (give the table of this fit)");
    fits.push_back({fit, std::filesystem::is_regular_file(name) ? name : file_of(name)});
  }
  if (options.fits.empty() && std::filesystem::is_directory(options.fit_folder))
    for (const Fit& fit : load_fits(options.fit_folder))
      if (converts(fit, table)) fits.push_back({fit, file_of(fit.id)});
  return fits;
}

// Returns the fit's id, or its file if another fit has the same id.
std::string shown_name(const NamedFit& one, const std::vector<NamedFit>& all) {
  const auto same =
      std::ranges::count_if(all, [&](const NamedFit& other) { return other.fit.id == one.fit.id; });
  return same > 1 ? one.file : one.fit.id;
}

Entry entry_of(const NamedFit& named, const std::string& name, const std::vector<TableRow>& rows,
               const std::string& digest) {
  const Fit& fit = named.fit;
  const bool own_table = fit.table.sha256 == digest;
  const std::vector<TableRow> inside = rows_inside(rows, fit.domain);
  const std::size_t outside = rows.size() - inside.size();
  const Residuals residuals = residuals_of(inside, fit);
  CandidateRecord candidate;
  candidate.name = name + " (" + fit_label(fit) + ")";
  candidate.number_count = number_count(fit.mapping);
  candidate.alpha = error_figures(residuals.alpha);
  candidate.specular = error_figures(residuals.specular);
  if (own_table) candidate.verdict = "fitted from this table, training rows included";
  if (outside != 0)
    candidate.verdict += (own_table ? "; " : "") + counted(outside, "row") + " outside its domain skipped";
  return {candidate,
          {{"kind", "fit"},
           {"file", named.file},
           {"fitted_from_this_table", own_table},
           {"rows_outside_domain", outside}},
          ""};
}

Entry entry_of(const Baseline& baseline, const std::vector<TableRow>& rows) {
  CandidateRecord candidate;
  candidate.name = baseline.name;
  candidate.verdict = baseline.map ? baseline.formula : "does not apply: " + baseline.why_not;
  if (baseline.map) {
    const Residuals residuals = residuals_of(rows, baseline.map);
    candidate.alpha = error_figures(residuals.alpha);
    candidate.specular = error_figures(residuals.specular);
  }
  return {candidate, {{"kind", "baseline"}, {"formula", baseline.formula}}, baseline.why_not};
}

void print_json(const Table& table, std::size_t row_count, const std::vector<Entry>& entries) {
  Json json = {{"table", table.name}, {"rows", row_count}, {"entries", Json::list()}};
  for (const Entry& entry : entries) {
    Json one = candidate_json(entry.candidate);
    one.update(entry.origin);
    json["entries"].push_back(std::move(one));
  }
  std::cout << json.dump(2) << "\n";
}

// Returns `A, B (why); C (why)`. If neighbours have the same reason, it appears once.
std::string why_not_text(const std::vector<Entry>& entries) {
  std::string text, reason;
  for (const Entry& entry : entries) {
    if (entry.why_not.empty()) continue;
    if (!text.empty()) text += entry.why_not == reason ? ", " : " (" + reason + "); ";
    text += entry.candidate.name;
    reason = entry.why_not;
  }
  return text.empty() ? "" : "Formulas that do not apply: " + text + " (" + reason + ")\n";
}

void run(const CompareOptions& options) {
  std::string bytes;
  const Table table = options.table.read(&bytes);
  const std::vector<TableRow> rows = answer_rows(table);
  if (rows.empty())
    throw input_error(table.name + ": no usable rows (its column status shows no successful match)");
  std::vector<Entry> entries;
  const std::vector<NamedFit> fits = chosen_fits(options, table);
  const std::string digest = sha256(bytes);
  for (const NamedFit& fit : fits) entries.push_back(entry_of(fit, shown_name(fit, fits), rows, digest));
  for (const Baseline& baseline : baselines(table.source, table.target))
    entries.push_back(entry_of(baseline, rows));
  if (options.json) {
    print_json(table, rows.size(), entries);
    return;
  }
  std::vector<CandidateRecord> candidates;
  for (const Entry& entry : entries)
    if (entry.why_not.empty()) candidates.push_back(entry.candidate);
  std::cout << table.name << ": " << rows.size() << " usable rows\n"
            << candidate_text(candidates, table.target.specular) << why_not_text(entries);
}

}  // namespace

void add_compare_command(Command& app) {
  Command* command = app.add_subcommand(
      "compare", "Compare fits and formulas in common use on the usable rows of a table", kFitStage);
  CompareOptions& options = set_work<CompareOptions>(*command, run);
  options.table.add_options(*command);
  command->add_option(
      "fit", options.fits,
      "Fits: files, or ids in the folder of fits (default: all that convert the table's models)");
  add_fits_option(*command, options.fit_folder, "Folder of fits");
  command->option_group("Output");
  command->add_flag("--json", options.json, "Print the figures as JSON to standard output");
  command->footer(
      "max is the largest error over all usable rows. `remapc fit --model auto` prints the same table for "
      "rows that were held out, with the errors of pictures.\n\n"
      "Example:\n  remapc compare ward_to_as.csv mitsuba_ward_to_mitsuba_as");
}

}  // namespace remap
