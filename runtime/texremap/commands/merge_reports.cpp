// This file is `texremap merge-reports`. It makes one report from the reports of all parts, and reports
// missing parts.
#include <iostream>
#include <optional>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/number_text.hpp"
#include "texremap/commands/commands.hpp"
#include "texremap/report/part_report.hpp"

namespace remap {
namespace {

struct MergeOptions {
  std::filesystem::path folder, output;
  bool force = false, json = false, quiet = false;
};

Json summary_json(const MergedReport& merged) {
  Json summary = {{"parts", merged.part_count},
                  {std::string(name_of(kListedKinds, merged.kind)), merged.entry_count},
                  {"converted", merged.converted},
                  {"done_before", merged.done_before},
                  {"failed", merged.failed},
                  {"skipped", merged.skipped},
                  {"bytes_read", merged.bytes_read},
                  {"bytes_written", merged.bytes_written}};
  if (merged.kind == ListedKind::kSets) summary["texels"] = merged.texels;
  summary["processor_seconds"] = merged.processor_seconds;
  summary["problems"] = merged.problems;
  return {{"summary", summary}};
}

// Nobody reads more failures on the screen. The report has all failures.
constexpr std::size_t kShownFailures = 20;

void merge(const MergeOptions& options) {
  if (!options.output.empty()) require_new(options.output, options.force);
  std::optional<NewFile> file;
  if (!options.output.empty()) file.emplace(options.output);
  const auto take = [&](std::string_view line) {
    if (options.json) std::cout << line << '\n';
    if (!file) return;
    file->add(line);
    file->add("\n");
  };
  const MergedReport merged = merge_reports(options.folder, take);
  take(summary_json(merged).dump());
  if (file) file->commit();
  for (const std::string& problem : merged.problems) say(problem);
  for (std::size_t i = 0; i < std::min(merged.failures.size(), kShownFailures); ++i)
    say("failed: " + merged.failures[i]);
  const std::string text = counted(merged.part_count, "part") + ": " +
                           counted(merged.converted, noun_of(merged.kind)) + " converted, " +
                           std::to_string(merged.failed) + " failed, " + std::to_string(merged.done_before) +
                           " done before, " + std::to_string(merged.skipped) + " skipped; " +
                           fixed(merged.processor_seconds, 1) + " s of processor time";
  if (!merged.problems.empty()) throw input_error(text + "; " + counted(merged.problems.size(), "problem"));
  if (merged.failed > 0) throw input_error(text);
  if (!options.quiet) say(text);
}

}  // namespace

void add_merge_reports_command(Command& app) {
  Command* command = app.add_subcommand(
      "merge-reports", "Make one report from the reports of all parts of a conversion; list what is missing");
  MergeOptions& options = set_work<MergeOptions>(*command, merge);
  command->add_option("DIR", options.folder, "The output folder of the conversion")->required();
  command->add_option("-o,--output FILE", options.output,
                      "File for the report: JSON, one line for each set or asset, then a summary");
  command->add_flag("--force", options.force, "Overwrite an existing report");
  command->add_flag("--json", options.json, "Print the report to standard output");
  command->add_flag("--quiet", options.quiet, "Print nothing but failures to standard error");
  command->footer(
      "The exit code is 1 if a set or an asset failed, if a part is missing, or if parts belong to different "
      "conversions or contain the same set.\n\n"
      "Example:\n"
      "  texremap merge-reports converted -o report.jsonl");
}

}  // namespace remap
