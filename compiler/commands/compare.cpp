// `remapc compare` prints the errors of fits and of formulas in common use on one table.
#include <algorithm>
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>

#include "command_line/command.hpp"
#include "commands/candidate_table.hpp"
#include "commands/commands.hpp"
#include "commands/table_input.hpp"
#include "fit/baselines.hpp"
#include "fit/edge.hpp"
#include "fit/fit_table.hpp"
#include "fit/rows/split.hpp"
#include "manifest/fit_folder.hpp"
#include "remap/error.hpp"
#include "report/fit_plot.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

struct CompareOptions {
  TableInput table;
  std::vector<std::string> fits;
  std::filesystem::path fit_folder = "fits";
  bool json = false;
};

struct NamedFit {
  remap::Fit fit;
  std::string file;
};

// The errors of a fit or a formula on the rows of the table.
struct Entry {
  remap::Candidate candidate;
  bool is_fit = false;
  bool applies = true;
  std::string file;              // of a fit
  bool own_table = false;        // fitted from this table
  std::size_t outside_rows = 0;  // outside its domain, not counted
  std::string formula;           // of a baseline
  std::string why_not;           // if it does not apply
};

bool converts(const remap::Fit& fit, const Table& table) {
  return (table.source.model.empty() || fit.source.model == table.source.model) &&
         (table.target.model.empty() || fit.target.model == table.target.model);
}

std::vector<NamedFit> chosen_fits(const CompareOptions& options, const Table& table) {
  std::vector<NamedFit> fits;
  const auto file_of = [&](const std::string& id) { return (options.fit_folder / (id + ".json")).string(); };
  for (const std::string& name : options.fits) {
    const remap::Fit fit = find_fit(name, options.fit_folder);
    if (!converts(fit, table))
      throw Error(ErrorKind::kInput, name + ": converts " + fit.source.model + " to " + fit.target.model +
                                         ", but the table is of " + table.source.model + " to " +
                                         table.target.model);
    fits.push_back({fit, std::filesystem::is_regular_file(name) ? name : file_of(name)});
  }
  if (options.fits.empty() && std::filesystem::is_directory(options.fit_folder))
    for (const remap::Fit& fit : load_fits(options.fit_folder))
      if (converts(fit, table)) fits.push_back({fit, file_of(fit.id)});
  return fits;
}

// The fit's id, or its file where another fit has the same id.
std::string shown_name(const NamedFit& one, const std::vector<NamedFit>& all) {
  const auto same = std::count_if(all.begin(), all.end(),
                                  [&](const NamedFit& other) { return other.fit.id == one.fit.id; });
  return same > 1 ? one.file : one.fit.id;
}

Entry entry_of(const NamedFit& named, const std::vector<TableRow>& rows, const std::string& digest) {
  const remap::Fit& fit = named.fit;
  Entry entry;
  entry.is_fit = true;
  entry.file = named.file;
  entry.own_table = fit.table.sha256 == digest;
  entry.candidate.number_count = remap::number_count(fit.mapping);
  const std::vector<TableRow> inside = rows_inside(rows, fit.domain);
  entry.outside_rows = rows.size() - inside.size();
  const RowErrors errors = row_errors(fit, inside);
  entry.candidate.alpha = errors.alpha;
  entry.candidate.specular = errors.specular;
  entry.candidate.chroma_shift = look_beyond(fit.mapping, fit.domain).chroma_shift;
  if (entry.own_table) entry.candidate.verdict = "fitted from this table, training rows included";
  if (entry.outside_rows != 0)
    entry.candidate.verdict += (entry.own_table ? "; " : "") + std::to_string(entry.outside_rows) +
                               " rows outside its domain skipped";
  return entry;
}

Entry entry_of(const Baseline& baseline, const std::vector<TableRow>& rows) {
  Entry entry;
  entry.candidate.name = baseline.name;
  entry.formula = baseline.formula;
  if (!baseline.map) {
    entry.applies = false;
    entry.why_not = baseline.why_not;
    entry.candidate.verdict = "does not apply: " + baseline.why_not;
    return entry;
  }
  std::vector<double> alpha, specular;
  for (const TableRow& row : rows) {
    const remap::MappedTexel texel = baseline.map(row.alpha1, row.specular1);
    alpha.push_back(texel.alpha - row.alpha2);
    specular.push_back(texel.specular - row.specular2);
  }
  entry.candidate.alpha = error_figures(std::move(alpha));
  entry.candidate.specular = error_figures(std::move(specular));
  entry.candidate.verdict = baseline.formula;
  return entry;
}

void print_json(const Table& table, std::size_t row_count, const std::vector<Entry>& entries) {
  nlohmann::ordered_json json = {
      {"table", table.name}, {"rows", row_count}, {"entries", nlohmann::json::array()}};
  for (const Entry& entry : entries) {
    nlohmann::ordered_json one = candidate_json(entry.candidate);
    one["kind"] = entry.is_fit ? "fit" : "baseline";
    if (entry.is_fit) {
      one["file"] = entry.file;
      one["fitted_from_this_table"] = entry.own_table;
      one["rows_outside_domain"] = entry.outside_rows;
    } else {
      one["formula"] = entry.formula;
    }
    json["entries"].push_back(std::move(one));
  }
  std::cout << json.dump(2) << "\n";
}

// `A, B (why); C (why)`: equal reasons of neighbors are given once.
std::string why_not_text(const std::vector<Entry>& entries) {
  std::string text, reason;
  for (const Entry& entry : entries) {
    if (entry.applies) continue;
    if (!text.empty()) text += entry.why_not == reason ? ", " : " (" + reason + "); ";
    text += entry.candidate.name;
    reason = entry.why_not;
  }
  return text.empty() ? "" : "Formulas that do not apply: " + text + " (" + reason + ")\n";
}

void run(const CompareOptions& options) {
  std::string bytes;
  const Table table = options.table.read(&bytes);
  const std::vector<TableRow> rows = usable_rows(table);
  if (rows.empty()) throw Error(ErrorKind::kInput, table.name + ": no usable rows");
  std::vector<Entry> entries;
  const std::vector<NamedFit> fits = chosen_fits(options, table);
  const std::string digest = sha256(bytes);
  for (const NamedFit& fit : fits) {
    entries.push_back(entry_of(fit, rows, digest));
    entries.back().candidate.name = shown_name(fit, fits) + " (" + fit_label(fit.fit) + ")";
  }
  for (const Baseline& baseline : baselines(table.source, table.target))
    entries.push_back(entry_of(baseline, rows));
  if (options.json) {
    print_json(table, rows.size(), entries);
    return;
  }
  std::vector<remap::Candidate> candidates;
  for (const Entry& entry : entries)
    if (entry.applies) candidates.push_back(entry.candidate);
  std::cout << table.name << ": " << rows.size() << " usable rows\n"
            << candidate_text(candidates, table.target.specular) << why_not_text(entries);
}

}  // namespace

void add_compare_command(remap::Command& app) {
  remap::Command* command = app.add_subcommand(
      "compare", "Compare fits and formulas in common use on the usable rows of a table", kFitStage);
  auto options = std::make_shared<CompareOptions>();
  options->table.add_options(*command);
  command->add_option(
      "fit", options->fits,
      "Fits: files, or ids in the folder of fits (default: all that convert the table's models)");
  command->add_option("--fits FOLDER", options->fit_folder, "Folder of fits");
  command->option_group("Output");
  command->add_flag("--json", options->json, "Print the figures as JSON to standard output");
  command->footer(
      "max is the largest error over all usable rows; chroma shift is the change of color beyond the domain. "
      "`remapc fit --model auto` prints the same table with cross-validation and errors at the domain's "
      "edge.\n\n"
      "Example:\n  remapc compare ward_to_as.csv mitsuba_ward_to_mitsuba_as");
  command->callback([options] { run(*options); });
}

}  // namespace remapc
