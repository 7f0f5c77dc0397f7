// `remapc export`: a fit to a lookup table for tools that take nothing else.
#include <iostream>
#include <map>
#include <memory>

#include <nlohmann/json.hpp>

#include "command_line/interruption.hpp"
#include "command_line/progress.hpp"
#include "commands/commands.hpp"
#include "emit/lookup_table.hpp"
#include "fit/rows/split.hpp"
#include "manifest/fit_folder.hpp"
#include "remap/error.hpp"
#include "system/files.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

const std::map<std::string, LookupOutput> kOutputs = {{"both", LookupOutput::kBoth},
                                                      {"roughness", LookupOutput::kRoughness},
                                                      {"specular", LookupOutput::kSpecular}};

struct ExportCommand {
  std::string fit;
  std::filesystem::path fit_folder = "fits";
  std::filesystem::path output;  // empty: <id>.csv
  std::string only = "both";
  LookupOptions options;
  bool json = false;
};

LookupTable sample_with_progress(const remap::Fit& fit, const LookupOptions& options) {
  constexpr double kUnits = 1000.0;
  remap::watch_interruptions();
  remap::Progress progress("export " + fit.id, static_cast<std::size_t>(kUnits));
  return sample_fit(fit, options, [&](double share) {
    if (remap::interruption())
      throw Error(ErrorKind::kInterrupted, "export: interrupted; nothing was written");
    progress.advance_to(static_cast<std::size_t>(kUnits * share));
  });
}

void print_json(const std::string& path, const remap::Fit& fit, const LookupTable& table) {
  nlohmann::ordered_json json = {{"lookup", path},
                                 {"id", fit.id},
                                 {"axes", nlohmann::json::array()},
                                 {"columns", nlohmann::json::array()},
                                 {"lookup_error_samples", table.judged_count}};
  for (const LookupAxis& axis : table.axes)
    json["axes"].push_back({{"name", axis.name},
                            {"size", axis.positions.size()},
                            {"min", axis.positions.front()},
                            {"max", axis.positions.back()}});
  for (const LookupColumn& column : table.columns)
    json["columns"].push_back(
        {{"name", column.name}, {"lookup_error", {{"rms", column.rms_error}, {"max", column.max_error}}}});
  std::cout << json.dump(2) << "\n";
}

void report(const std::string& path, const LookupTable& table) {
  std::cerr << path << ": ";
  for (std::size_t a = 0; a < table.axes.size(); ++a)
    std::cerr << (a == 0 ? "" : " x ") << table.axes[a].positions.size() << " " << table.axes[a].name;
  std::cerr << (table.axes.size() == 1 ? "; linear" : "; bilinear") << " lookup is off the fit by at most";
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    std::cerr << (c == 0 ? " " : ", ") << error_text(table.columns[c].max_error) << " in "
              << table.columns[c].name;
  std::cerr << "\n";
}

void run(ExportCommand command) {
  const remap::Fit fit = find_fit(command.fit, command.fit_folder);
  if (command.output.empty()) command.output = fit.id + ".csv";
  command.options.output = kOutputs.at(command.only);
  remap::create_parent(command.output);
  const LookupTable table = sample_with_progress(fit, command.options);
  remap::write_file(command.output, lookup_text(fit, table));
  if (command.json)
    print_json(command.output.string(), fit, table);
  else
    report(command.output.string(), table);
}

// The format, for whoever has to read the file.
const char* const kFormat =
    "The file is CSV behind `# key: value` lines:\n"
    "  format, format_version   remap-lookup, 1\n"
    "  tool, id, kind           what made it, and of which fit\n"
    "  source, target           models; _roughness, _specular: what they call their parameters\n"
    "  fitted_table_sha256      of the table that was fitted\n"
    "  axes                     one name an axis: source_WIDTH, or source_WIDTH,source_SPECULAR\n"
    "  size                     samples on each axis\n"
    "  domain_min, domain_max   first and last sample on each axis; steps are even\n"
    "  columns                  target_WIDTH, and on two axes target_SPECULAR, on one\n"
    "                           target_SPECULAR_factor: multiply the source's specular by it\n"
    "  interpolation            linear or bilinear: how it is meant to be read\n"
    "  order                    of rows, where there are two axes: the last varies fastest\n"
    "  outside                  what to do beyond the domain, as generated headers do it\n"
    "  source_alpha             of --canonical, target_alpha too: alpha by the model's own parameter\n"
    "  lookup_error_max, _rms   of such reading against the fit, in the unit of each column, measured at\n"
    "                           lookup_error_samples points between the samples\n"
    "then a row of names and one row a sample: axes, then columns, in the models' own parameters. The\n"
    "width of a colored specular is read at its largest channel. The table has one axis where no column\n"
    "depends on specular; --only leaves out the one that does. --json gives axes, columns and errors.\n";

}  // namespace

void add_export_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "export", "Write a fit as a lookup table (CSV) for tools that take nothing but tables");
  auto options = std::make_shared<ExportCommand>();
  command->add_option("fit", options->fit, "Fit: file, or id in the folder of fits")->required();
  command->add_option("--fits", options->fit_folder, "Folder of fits")->capture_default_str();
  command->add_option("-o,--output", options->output, "Table to write; default: <id>.csv");
  command->add_option("--size", options->options.size, "Samples over the source's width")
      ->check(CLI::Range(2, static_cast<int>(kMostLookupRows)))
      ->capture_default_str();
  command
      ->add_option("--size-specular", options->options.specular_size,
                   "Samples over the source's specular, where the table has that axis")
      ->check(CLI::Range(2, static_cast<int>(kMostLookupRows)))
      ->capture_default_str();
  command->add_option("--only", options->only, "roughness or specular: a table of that output alone")
      ->check(CLI::IsMember({"both", "roughness", "specular"}))
      ->capture_default_str();
  command->add_flag("--canonical", options->options.canonical,
                    "Widths as alpha in place of the models' own parameters: for exponents, of which even "
                    "steps leave most materials to the first");
  command
      ->add_option("--jobs", options->options.jobs, "Threads; 0: one a core. The table does not depend on it")
      ->capture_default_str();
  command->add_flag("--json", options->json, "Summary as JSON on standard output");
  command->footer(std::string(kFormat) +
                  "Example:\n  remapc export mitsuba_ward_to_mitsuba_as --size 129 -o ward_to_as.csv");
  command->callback([options] { run(*options); });
}

}  // namespace remapc
