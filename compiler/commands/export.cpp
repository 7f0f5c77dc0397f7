// `remapc export` writes a fit as a lookup table.
#include <functional>
#include <iostream>
#include <map>

#include <nlohmann/json.hpp>

#include "commands/commands.hpp"
#include "commands/share_progress.hpp"
#include "emit/lookup_table.hpp"
#include "fit/rows/split.hpp"
#include "manifest/fit_folder.hpp"
#include "system/files.hpp"

namespace remapc {
namespace {

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
  std::cerr << (table.axes.size() == 1 ? "; linear" : "; bilinear")
            << " lookup deviates from the fit by at most";
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
  const LookupTable table = [&] {
    ShareProgress progress("export", fit.id);
    return sample_fit(fit, command.options, std::ref(progress));
  }();
  remap::write_file(command.output, lookup_text(fit, table));
  if (command.json)
    print_json(command.output.string(), fit, table);
  else
    report(command.output.string(), table);
}

// The file format, at the end of --help.
const char* const kFormat =
    "The file is CSV after `# key: value` lines:\n"
    "  format, format_version   remap-lookup, 1\n"
    "  tool, id, kind           the program, the fit and its kind\n"
    "  source, target           models; _roughness, _specular: their parameters\n"
    "  fitted_table_sha256      SHA-256 of the table that was fitted\n"
    "  axes                     source_WIDTH, or source_WIDTH,source_SPECULAR\n"
    "  size                     samples on each axis\n"
    "  domain_min, domain_max   first and last sample on each axis; even steps\n"
    "  columns                  target_WIDTH, and target_SPECULAR (two axes) or\n"
    "                           target_SPECULAR_factor (one axis), which multiplies\n"
    "                           the source's specular\n"
    "  interpolation            linear or bilinear\n"
    "  order                    of rows, with two axes: the last axis varies fastest\n"
    "  outside                  what to do outside the domain, as headers do it\n"
    "  source_alpha             with --canonical, also target_alpha: formula of alpha\n"
    "                           by the model's own parameter\n"
    "  lookup_error_max, _rms   deviation of lookups from the fit, in the unit of\n"
    "                           each column, at lookup_error_samples points\n"
    "A row of names follows, then a row per sample: axes, then columns, in the models' own parameters. For a "
    "colored specular, look the width up at its largest channel. The table has one axis if no column depends "
    "on specular; --only can leave out the one that does.\n\n";

}  // namespace

void add_export_command(remap::Command& app) {
  remap::Command* command = app.add_subcommand(
      "export", "Write a fit as a lookup table (CSV), for tools that cannot use the header", kCompileStage);
  ExportCommand& options = set_work<ExportCommand>(*command, run);
  command->add_option("fit", options.fit, "Fit: file, or id in the folder of fits")->required();
  command->option_group("Input");
  command->add_option("--fits FOLDER", options.fit_folder, "Folder where ids are looked up");
  command->option_group("Table");
  command->add_option("--size", options.options.size, "Samples on the axis of the source's width")
      ->range(2, static_cast<int>(kMostLookupRows));
  command
      ->add_option("--size-specular", options.options.specular_size,
                   "Samples on the axis of the source's specular, if the table has it")
      ->range(2, static_cast<int>(kMostLookupRows));
  command->add_option("--only", options.only, "Output to write")->one_of({"both", "roughness", "specular"});
  command->add_flag("--canonical", options.options.canonical,
                    "Write widths as alpha instead of the models' own parameters; needed for exponents, "
                    "where even steps put most materials into the first cell");
  command->option_group("Output");
  command->add_option("-o,--output FILE", options.output, "Table to write (default: <id>.csv)");
  command->add_flag("--json", options.json, "Print axes, columns and errors as JSON to standard output");
  command
      ->add_option("--jobs", options.options.jobs,
                   "Threads, 0: one per core; the table does not depend on it")
      ->group(remap::kRareOptions);
  command->footer(std::string(kFormat) +
                  "Example:\n  remapc export mitsuba_ward_to_mitsuba_as --size 129 -o ward_to_as.csv");
}

}  // namespace remapc
