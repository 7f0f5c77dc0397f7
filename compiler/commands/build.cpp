// This file is `remapc build`, which makes the items of a manifest that are out of date.
#include "build/build.hpp"

#include <iostream>

#include "command_line/command.hpp"
#include "command_line/progress.hpp"
#include "commands/commands.hpp"
#include "core/errors.hpp"
#include "core/json.hpp"
#include "core/number_text.hpp"
#include "core/system.hpp"
#include "remap/error.hpp"
#include "worker/renderer_set.hpp"

namespace remap {
namespace {

struct BuildCommand {
  BuildFolders folders;
  RendererOptions renderers;
  BuildExecution execution;
  bool check = false, json = false;
};

void run_check(const BuildCommand& command, const Manifest& manifest) {
  const std::vector<std::string> reasons = stale(manifest, command.folders);
  if (command.json)
    std::cout << Json({{"items", manifest.size()}, {"stale", reasons}}).dump(2) << "\n";
  else
    for (const std::string& reason : reasons) std::cout << reason << "\n";
  if (!reasons.empty())
    throw input_error(command.folders.fits.string() + ": " + counted(reasons.size(), "item") +
                      (reasons.size() == 1 ? " is" : " are") + " out of date (run `remapc build`)");
}

std::string seconds_text(double seconds) { return number_text(rounded_up(seconds, 2)) + " s"; }

// Returns the stages that took the time of an item: ` (sweep 12 s, of it 9 s for 1409 pictures; fit 4 s)`.
// Returns an empty text if the item was up to date.
std::string stages_text(const BuiltItem& item) {
  std::string text;
  const auto add = [&](const char* stage, double seconds) {
    if (seconds >= 0.1) text += (text.empty() ? " (" : "; ") + (stage + (" " + seconds_text(seconds)));
  };
  add("sweep", item.sweep_seconds);
  if (!text.empty())
    text += ", including " + seconds_text(item.picture_seconds) + " for " + std::to_string(item.pictures) +
            " pictures";
  add("fit", item.fit_seconds);
  add("lowering", item.lowering_seconds);
  return text.empty() ? "" : text + ")";
}

void report(const BuildCommand& command, const Manifest& manifest, const BuildResult& result,
            double seconds) {
  const std::vector<std::string> vanished = vanished_items(manifest, command.folders);
  if (command.json) {
    Json json = {{"items", manifest.size()}, {"seconds", seconds},     {"pruned", result.pruned},
                 {"vanished", vanished},     {"failed", Json::list()}, {"built", Json::list()}};
    for (const auto& [id, error] : result.failed)
      json["failed"].push_back({{"id", id}, {"why", std::string(error.what())}});
    for (const BuiltItem& item : result.built)
      json["built"].push_back({{"id", item.id},
                               {"table", item.table},
                               {"fit", item.fit},
                               {"header", item.header},
                               {"kept_table", item.kept_table},
                               {"pictures", item.pictures},
                               {"seconds",
                                {{"sweep", item.sweep_seconds},
                                 {"pictures", item.picture_seconds},
                                 {"fit", item.fit_seconds},
                                 {"lowering", item.lowering_seconds},
                                 {"all", item.seconds}}}});
    std::cout << json.dump(2) << "\n";
    return;
  }
  for (const std::string& id : result.pruned)
    std::cerr << id << ": no longer in the manifest, so its files were removed\n";
  for (const std::string& id : vanished)
    std::cerr << id << ": no longer in the manifest; its files are kept"
              << (command.execution.prune ? " because they were edited after the last build"
                                          : " (--prune removes them)")
              << "\n";
  for (const BuiltItem& item : result.built)
    if (!item.kept_table.empty()) std::cerr << item.id << ": table kept: " << item.kept_table << "\n";
  for (const BuiltItem& item : result.built)
    std::cerr << item.id << ": " << (item.table ? "table, " : "") << (item.fit ? "fit, " : "") << "header in "
              << seconds_text(item.seconds) << stages_text(item) << "\n";
  std::cerr << manifest.size() << " items, " << result.built.size() << " built, " << seconds_text(seconds)
            << "\n";
}

void require_success(const BuildResult& result, std::size_t items) {
  if (result.failed.empty()) return;
  std::string text;
  for (const auto& [id, error] : result.failed) text += (text.empty() ? "" : "; ") + id + ": " + error.what();
  if (result.failed.size() > 1)
    text = std::to_string(result.failed.size()) + " of " + std::to_string(items) + " items failed: " + text;
  throw Error(result.failed.begin()->second.kind(), text);
}

void run(const BuildCommand& command) {
  const Stopwatch stopwatch;
  const Manifest manifest = load_manifest(command.folders.fits);
  if (command.check) {
    run_check(command, manifest);
    return;
  }
  watch_interruptions();
  const auto renderer = make_renderers(command.renderers);
  BuildResult result;
  {
    Progress progress("build " + command.folders.fits.string(), manifest.size());
    BuildExecution execution = command.execution;
    execution.cancelled = &interruption();
    execution.progress = [&](std::size_t done, std::size_t) { progress.advance_to(done); };
    result = build(*renderer, manifest, command.folders, execution);
  }
  report(command, manifest, result, stopwatch.seconds());
  require_success(result, manifest.size());
}

}  // namespace

void add_build_command(Command& app) {
  Command* command = app.add_subcommand(
      "build", "Make every table, fit and header of fits/manifest.json that is out of date", kCompileStage);
  BuildCommand& options = set_work<BuildCommand>(*command, run);
  command->option_group("Folders");
  command->add_option("--fits FOLDER", options.folders.fits,
                      "Folder of fits, with manifest.json, tables/ and the report README.md");
  command->add_option("-o,--output FOLDER", options.folders.generated, "Folder for the headers");
  command->option_group("What to make");
  command->add_flag("--check", options.check,
                    "Write nothing, list the items that are out of date; exit code 1 if there are any");
  command->add_flag("--force", options.execution.force, "Make every item again");
  command->add_flag("--prune", options.execution.prune,
                    "Remove files of items that the manifest no longer lists, unless they were edited");
  command->add_flag("--json", options.json, "Print the result as JSON to standard output");
  command->option_group(kRareOptions);
  command->add_option("--jobs", options.execution.jobs,
                      "Items made at a time, 0: one per core; the results do not depend on it");
  add_renderer_options(*command, options.renderers);
  command->footer(
      "An item is out of date if its entry in the manifest, its inputs or one of its files differ from "
      "manifest.lock. --check compares converters.json with manifest.lock, too; `remapc emit --all --check` "
      "makes headers and converters.json again and compares their text. An interrupted build continues "
      "where it stopped.\n\n"
      "Example:\n  remapc build");
}

}  // namespace remap
