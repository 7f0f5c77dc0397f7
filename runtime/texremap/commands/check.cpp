// This file is `texremap check`. It reports what looks wrong in materials. It converts and writes nothing.
#include <algorithm>
#include <iostream>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "check/rules.hpp"
#include "command_line/command.hpp"
#include "command_line/help_text.hpp"
#include "command_line/progress.hpp"
#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/json.hpp"
#include "core/number_text.hpp"
#include "core/packed_values.hpp"
#include "core/plain_text.hpp"
#include "sets/naming.hpp"
#include "texremap/commands/commands.hpp"
#include "texremap/options/convert_options.hpp"
#include "texremap/plan/asset_formats.hpp"
#include "texremap/run/job_processes.hpp"
#include "texture/image_library.hpp"

namespace remap {

// Lists all members, so that another process can send them (packed_values.hpp). Rule names are sent as
// pointers to constants, which are valid here, because the other process is a copy of this one.
template <typename Archive>
void fields(Archive& archive, Fix& fix) {
  archive(fix.words, fix.command, fix.asset, fix.output, fix.options);
}
template <typename Archive>
void fields(Archive& archive, MaterialFinding& finding) {
  archive(finding.rule, finding.confidence, finding.context, finding.channel, finding.message, finding.fix);
}

namespace {

struct CheckOptions {
  std::vector<std::filesystem::path> paths;
  std::string names;
  const GltfConsumer* reader = nullptr;
  std::vector<std::string> ignored;  // names of rules
  Confidence fails_on = Confidence::kCertain;
  unsigned thread_count = 0;
  int memory_megabytes = 0;
  bool json = false;
  bool quiet = false;
};

Reader<std::vector<std::string>> rule_names() {
  std::vector<std::string> known;
  for (const Rule& rule : rules()) known.emplace_back(rule.name);
  return list_of(Reader<std::string>{[known](const std::string& option, const std::string& word) {
                                       if (!contains(known, word)) fail_unknown(option, "rule", word, known);
                                       return word;
                                     },
                                     {}});
}

// A MaterialReport holds the findings in one material, and messages about files that cannot be read.
struct MaterialReport {
  std::vector<MaterialFinding> findings;
  std::vector<std::string> problems;
  std::size_t map_count = 0;
};

template <typename Archive>
void fields(Archive& archive, MaterialReport& report) {
  archive(report.findings, report.problems, report.map_count);
}

MaterialReport look_at(CheckedMaterial material, const CheckOptions& options) {
  MaterialReport report;
  report.problems = material.read_maps();
  report.map_count = material.maps.size();
  report.findings = findings_in(material, options.reader);
  std::erase_if(report.findings,
                [&](const MaterialFinding& finding) { return contains(options.ignored, finding.rule); });
  return report;
}

void print(const MaterialFinding& finding) {
  const std::string context = finding.context + (finding.channel.empty() ? "" : ":" + finding.channel);
  std::cout << plain(context + ": " + finding.message) << " [" << finding.rule << ", "
            << name_of(kConfidences, finding.confidence) << "]\n"
            << "    " << plain(finding.fix.text()) << '\n';
}

Json finding_json(const MaterialFinding& finding) {
  return {{"rule", finding.rule},          {"confidence", name_of(kConfidences, finding.confidence)},
          {"path", finding.context},       {"channel", finding.channel},
          {"message", finding.message},    {"fix", finding.fix.text()},
          {"command", finding.fix.command}};
}

void check(const CheckOptions& options) {
  const Naming naming = options.names.empty() ? built_in_naming() : read_naming(options.names);
  FoundMaterials found;
  std::vector<std::shared_ptr<const ScratchFolder>> embedded;
  for (const std::filesystem::path& path : options.paths) {
    require_readable(path);
    FoundMaterials own = materials_of(path, naming);
    std::ranges::move(own.materials, std::back_inserter(found.materials));
    std::ranges::move(own.problems, std::back_inserter(found.problems));
    embedded.push_back(std::move(own.embedded));
  }
  if (found.materials.empty() && found.problems.empty())
    throw usage_error(
        options.paths.front().string() +
        ": no map found by file names, and no glTF or MTL file (use --names FILE for other names)");
  std::vector<MaterialReport> reports(found.materials.size());
  Progress progress("materials", reports.size(), !options.quiet);
  const std::size_t threads =
      options.thread_count > 0 ? options.thread_count : std::max(1u, std::thread::hardware_concurrency());
  set_image_limits(0, memory_limit(options.memory_megabytes) / threads);
  ApartJobs apart;
  apart.count = reports.size();
  apart.at_once = static_cast<unsigned>(threads);
  apart.work = [&](std::size_t i, const std::function<void(double)>&) {
    if (interruption()) throw Error(ErrorKind::kInterrupted, "interrupted");
    return packed(look_at(std::move(found.materials[i]), options));
  };
  apart.finished = [&](std::size_t i, std::string result) {
    reports[i] = unpacked<MaterialReport>(std::move(result));
    progress.advance();
  };
  apart.crashed = [&](std::size_t i, const std::string& reason) {
    reports[i].problems.push_back(found.materials[i].name + ": " + reason);
    progress.advance();
  };
  run_apart(apart);
  progress.hide();
  std::vector<MaterialFinding*> findings;
  for (MaterialReport& one : reports)
    for (MaterialFinding& finding : one.findings) findings.push_back(&finding);
  unite_conversions(findings);
  Json json = {{"version", 1},
               {"for", options.reader != nullptr ? Json(options.reader->name) : Json()},
               {"materials", reports.size()},
               {"maps", 0},
               {"findings", Json::list()},
               {"problems", Json::list()}};
  std::size_t count = 0, failing = 0, maps = 0;
  for (const MaterialReport& one : reports) {
    std::ranges::copy(one.problems, std::back_inserter(found.problems));
    maps += one.map_count;
    count += one.findings.size();
    for (const MaterialFinding& finding : one.findings) {
      failing += finding.confidence <= options.fails_on;
      options.json ? json["findings"].push_back(finding_json(finding)) : print(finding);
    }
  }
  const std::set<std::string> problems(found.problems.begin(), found.problems.end());
  for (const std::string& problem : problems) {
    json["problems"].push_back(problem);
    say("not read: " + problem);
  }
  json["maps"] = maps;
  if (options.json) std::cout << json.dump(2) << '\n';
  const std::string all = counted(reports.size(), "material") + ", " + counted(maps, "map");
  if (failing > 0 || !problems.empty())
    throw input_error(all + ": " + counted(count, "finding") +
                      (problems.empty() ? "" : ", " + counted(problems.size(), "file") + " not read"));
  if (options.quiet) return;
  say(all + ": " +
      (count == 0 ? "nothing looks wrong"
                  : counted(count, "finding") + ", none of which is " +
                        std::string(name_of(kConfidences, options.fails_on)) +
                        " (--fail-on possible fails on these, too)"));
}

}  // namespace

void add_check_command(Command& app) {
  Command* command =
      app.add_subcommand("check", "Look for wrong conventions in maps and assets; write nothing");
  CheckOptions& options = set_work<CheckOptions>(*command, check);
  command->add_option("PATH", options.paths, "Folders of texture sets or assets, glTF or MTL files, or maps")
      ->required();
  command->add_option("--for NAME", options.reader, one_of(gltf_consumers(), "importer"),
                      "Also report what this importer ignores or reads differently");
  command->add_option("--ignore RULES", options.ignored, rule_names(), "Rules to skip, comma-separated");
  command
      ->add_option("--fail-on CONFIDENCE", options.fails_on, one_of(kConfidences, "confidence"),
                   "Exit with code 1 if a finding is at least this sure")
      ->default_text("certain");
  command->add_option("--names FILE", options.names, "More naming conventions (JSON)");
  command->add_option("--threads N", options.thread_count, "Number of threads; 0 for one per core");
  add_memory_option(*command, options.memory_megabytes);
  command->add_flag("--json", options.json, "Print the findings as JSON to standard output");
  command->add_flag("--quiet", options.quiet, "Print nothing but findings and errors");
  std::string text = "The exit code is 1 if something certain is wrong (--fail-on). Rules:\n";
  for (const Rule& rule : rules())
    text += "  " + std::string(rule.name) + "\n      " + wrapped(rule.detects, 6) + "\n";
  command->footer(text + "\nExample:\n  texremap check assets\n  texremap check model.glb --for godot");
}

}  // namespace remap
