// This file is `texremap plan`. It writes files that hand a conversion in parts to a scheduler. It measures a
// few entries to estimate what a part needs, and submits nothing.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <numeric>

#include "command_line/run_app.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json.hpp"
#include "core/number_text.hpp"
#include "core/system.hpp"
#include "texremap/commands/commands.hpp"
#include "texremap/commands/farm_plan.hpp"
#include "texremap/plan/convert_plan.hpp"
#include "texremap/plan/manifest.hpp"

namespace remap {
namespace {

struct PlanOptions {
  PlanKind kind = PlanKind::kCommands;
  std::filesystem::path manifest, folder;
  std::vector<std::string> words;  // words for convert
  std::size_t parts = 0;           // 0: automatic
  unsigned threads = 1;
  int memory_megabytes = 0, minutes = 0;  // 0: measured
  std::string program;
  bool force = false, json = false, quiet = false;
};

// A part takes a quarter of an hour. Its start takes little of this, and a killed job loses little work.
constexpr double kUsualSeconds = 900.0;
// Slurm refuses more parts if the cluster keeps the default of MaxArraySize.
constexpr std::size_t kMostParts = 1000;
constexpr std::size_t kMeasuredEntries = 8;

// A Measurement holds time and memory of a conversion on this machine.
struct Measurement {
  double seconds_a_cost = 0.0;  // seconds for each unit of cost, on one thread
  double memory_bytes = 0.0;
};

// Returns the entry with the largest cost, and entries at even steps through the list that is sorted by cost.
TreeManifest sample_of(const TreeManifest& manifest) {
  std::vector<std::size_t> order(manifest.costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return manifest.costs[i]; });
  const std::size_t count = std::min(kMeasuredEntries, order.size());
  TreeManifest sample;
  sample.head.kind = manifest.head.kind;
  for (std::size_t i = 1; i <= count; ++i) {
    const std::size_t at = order[i * order.size() / count - 1];
    if (sample.head.kind == ListedKind::kSets)
      sample.found.sets.push_back(manifest.found.sets[at]);
    else
      sample.assets.push_back(manifest.assets[at]);
  }
  return sample;
}

Measurement measured(const TreeManifest& manifest, ConvertOptions options) {
  const ScratchFolder scratch("texremap-plan");
  options.manifest = scratch.file("sets.jsonl");
  options.output = scratch.file("out");
  if (!options.diagnose.empty()) options.diagnose = scratch.file("diagnose");
  options.quiet = true;
  options.thread_count = 1;
  const ManifestHead head = write_manifest(options.manifest, options.folder, "", sample_of(manifest));
  const Stopwatch stopwatch;
  try {
    convert(options);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    say(std::string("note: while measuring: ") + error.what());
  }
  return {stopwatch.seconds() / static_cast<double>(std::max<std::uint64_t>(head.cost, 1)),
          static_cast<double>(resource_use().peak_memory_bytes)};
}

std::uint64_t highest_cost_of_part(const TreeManifest& manifest, std::size_t count) {
  std::vector<std::uint64_t> parts(count, 0);
  std::uint64_t before = 0;
  for (const std::uint64_t cost : manifest.costs) {
    parts[part_of_entry(before, cost, manifest.head, count) - 1] += cost;
    before += cost;
  }
  return *std::ranges::max_element(parts);
}

std::filesystem::path whole(const std::filesystem::path& path) {
  return std::filesystem::absolute(path).lexically_normal();
}

// Reads the options of convert from the words for a plan. Throws kUsage for options of the plan itself.
ConvertOptions options_of(const std::vector<std::string>& words) {
  Command command("The options of texremap convert", "texremap convert");
  ConvertOptions options;
  add_convert_options(command, options);
  const std::string reason = ": texremap plan adds this option itself (remove this option)";
  for (const std::string& word : words)
    if (const std::string name = word.substr(0, word.find('=')); (command.tags_of(name) & kOfPlan) != 0)
      throw usage_error(name + reason);
  run_words(command, words);
  note_given(command, options);
  refuse(options, kOfPlan, reason);
  if (options.output.empty())
    throw usage_error("--output is required after -- (add -o FOLDER there, for the results)");
  return options;
}

// Returns the options without the output folder, with absolute paths, because jobs run in other folders.
std::vector<std::string> words_of_jobs(const ConvertOptions& options) {
  std::vector<std::string> words;
  for (const GivenOption& option : options.given) {
    if (option.name == "--output") continue;
    const bool is_path = (option.tags & kIsPath) != 0;
    if (option.words.empty()) words.push_back(option.name);
    for (const std::string& word : option.words) {
      words.push_back(option.name);
      words.push_back(is_path ? whole(word).string() : word);
    }
  }
  if (!options.quiet) words.emplace_back("--quiet");
  return words;
}

std::string own_program() {
  const std::filesystem::path path = program_file();
  return path.empty() ? "texremap" : path.string();
}

int rounded_up(double value, int step) { return static_cast<int>(std::ceil(value / step)) * step; }

void plan(const PlanOptions& options) {
  const ConvertOptions asked = options_of(options.words);
  const TreeManifest manifest = read_manifest(options.manifest, Part());
  if (manifest.costs.empty())
    throw input_error(options.manifest.string() + ": lists no " + std::string(noun_of(manifest.head.kind)));
  ConvertOptions conversion = asked;
  conversion.manifest = options.manifest;
  conversion.folder = manifest.head.root;
  conversion.quiet = options.quiet;
  for (const std::string& message : resolve(conversion).messages)
    if (!options.quiet) say(message);

  PlannedFarm farm{options.program.empty() ? own_program() : options.program,
                   whole(options.manifest),
                   manifest.head.root,
                   whole(asked.output),
                   whole(options.folder),
                   whole(options.folder) / "report.jsonl",
                   words_of_jobs(asked)};
  require_writable(options.kind, farm);
  const bool is_given = options.parts > 0 && options.minutes > 0 && options.memory_megabytes > 0;
  const Measurement one = is_given ? Measurement() : measured(manifest, conversion);
  const double threads = std::max(options.threads, 1u);
  const double seconds = one.seconds_a_cost * static_cast<double>(manifest.head.cost);
  farm.threads = options.threads;
  farm.parts = options.parts > 0
                   ? options.parts
                   : std::clamp(static_cast<std::size_t>(std::ceil(seconds / threads / kUsualSeconds)),
                                std::size_t{1}, std::min(kMostParts, manifest.costs.size()));
  const double longest =
      one.seconds_a_cost * static_cast<double>(highest_cost_of_part(manifest, farm.parts)) / threads;
  // Allow more time, because other machines and shared storage are slower.
  farm.minutes = options.minutes > 0 ? options.minutes : rounded_up(5.0 + 3.0 * longest / 60.0, 5);
  farm.memory_megabytes = options.memory_megabytes > 0 ? options.memory_megabytes
                                                       : rounded_up(1.5e-6 * one.memory_bytes * threads, 100);

  const auto files = plan_files(options.kind, farm);
  const std::string submit = submit_command(options.kind, farm);
  for (const auto& [name, text] : files) require_new(options.folder / name, options.force);
  Json names = Json::list();
  for (const auto& [name, text] : files) {
    write_file(options.folder / name, text);
    names.push_back((options.folder / name).string());
  }
  if (options.json) {
    std::cout << Json({{"files", names},
                       {"submit", submit},
                       {std::string(name_of(kListedKinds, manifest.head.kind)), manifest.head.count},
                       {"parts", farm.parts},
                       {"threads", farm.threads},
                       {"minutes", farm.minutes},
                       {"memory_megabytes", farm.memory_megabytes},
                       {"expected_seconds", is_given ? Json() : Json(seconds)},
                       {"expected_seconds_of_longest_part", is_given ? Json() : Json(longest)}})
                     .dump(2)
              << '\n';
    return;
  }
  if (!options.quiet) {
    std::string text =
        counted(manifest.head.count, noun_of(manifest.head.kind)) + " in " + counted(farm.parts, "part");
    if (!is_given)
      text += ": about " + fixed(seconds / 60.0, 1) + " processor minutes on this machine, " +
              fixed(longest / 60.0, 1) + " for the longest part";
    say(text + "; each part may use " + std::to_string(farm.memory_megabytes) + " MB and " +
        counted(static_cast<std::size_t>(farm.minutes), "minute"));
    if (farm.parts > kMostParts && options.kind == PlanKind::kSlurm)
      say("note: clusters with the default MaxArraySize refuse more than " + std::to_string(kMostParts) +
          " parts");
  }
  std::cout << submit << '\n';
}

}  // namespace

void add_plan_command(Command& app) {
  Command* command = app.add_subcommand(
      "plan", "Write the files that run a conversion in parts on a cluster; submit nothing");
  PlanOptions& options = set_work<PlanOptions>(*command, plan);
  command
      ->add_option("KIND", options.kind, one_of(kPlanKinds, "kind of plan"),
                   "slurm (batch scripts), openjd (a job template of render farms) or commands (one on each "
                   "line, for GNU parallel and others)")
      ->required();
  command
      ->add_option("--manifest FILE", options.manifest,
                   "Manifest of the sets or assets, written by texremap index")
      ->required();
  command->add_option("-o,--output FOLDER", options.folder, "Folder for the plan")->required();
  command->add_option("OPTIONS", options.words,
                      "After --: options of texremap convert, with -o for the results");
  command->add_option("--parts N", options.parts, "Number of parts")
      ->range(std::size_t{1}, std::size_t{1'000'000})
      ->default_text("parts of a quarter of an hour, 1000 at most");
  command->add_option("--threads N", options.threads,
                      "Threads for each part; 0 for all cores of the machine");
  command->add_option("--memory MB", options.memory_megabytes, "Memory of each part")
      ->positive()
      ->default_text("measured");
  command->add_option("--time MINUTES", options.minutes, "Time limit of each part")
      ->positive()
      ->default_text("measured");
  command->add_option("--program FILE", options.program,
                      "Program that the jobs start (default: this texremap)");
  command->add_flag("--force", options.force, "Overwrite an existing plan");
  command->add_flag("--json", options.json, "Print what was planned as JSON");
  command->add_flag("--quiet", options.quiet, "Print nothing but errors to standard error");
  command->footer(
      "texremap converts a few of the sets or assets to a temporary folder, to measure time and memory. It "
      "prints the command that submits the plan.\n\n"
      "Example:\n"
      "  texremap plan slurm --manifest sets -o plan -- --from unity --to gltf -o out\n"
      "  sh plan/submit.sh");
}

}  // namespace remap
