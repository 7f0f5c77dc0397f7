// `remapc worker-check` reports what is wrong with a worker.
#include <algorithm>
#include <iomanip>
#include <iostream>

#include "command_line/interruption.hpp"
#include "commands/commands.hpp"
#include "commands/renderer_options.hpp"
#include "remap/named_values.hpp"
#include "text/errors.hpp"
#include "text/json.hpp"
#include "worker/conformance.hpp"
#include "worker/renderer_set.hpp"

namespace remapc {
namespace {

struct WorkerCheck {
  std::string command;
  int resolution = 48;
  WorkerLimits limits;
  bool json = false;
};

using Verdict = WorkerFinding::Verdict;
constexpr remap::NamedValues<Verdict, 3> kVerdicts = {
    {{Verdict::kGood, "good"}, {Verdict::kRemark, "remark"}, {Verdict::kWrong, "wrong"}}};

// The registered worker of that name, or else a worker with that command.
WorkerEntry entry_of(const std::string& command) {
  for (const WorkerEntry& entry : known_workers({}))
    if (entry.name == command) return entry;
  return {"", command, std::filesystem::current_path().string(), ""};
}

void print(const std::vector<WorkerFinding>& findings) {
  std::string model;
  for (const WorkerFinding& finding : findings) {
    if (finding.model != model) std::cout << finding.model << "\n";
    model = finding.model;
    std::cout << "  " << std::left << std::setw(8) << name_of(kVerdicts, finding.verdict) << std::setw(16)
              << finding.check << finding.words << "\n";
  }
}

void run(const WorkerCheck& check) {
  remap::watch_interruptions();
  WorkerLimits limits = check.limits;
  limits.cancelled = &remap::interruption();
  const PrivateFolder folder;
  Worker worker(entry_of(check.command), limits, folder.path() / "picture.f32");
  const std::vector<WorkerFinding> findings = check_worker(worker, check.resolution);
  const auto wrong = std::count_if(findings.begin(), findings.end(), [](const WorkerFinding& finding) {
    return finding.verdict == Verdict::kWrong;
  });
  if (check.json) {
    remap::Json list = remap::Json::list();
    for (const WorkerFinding& finding : findings)
      list.push_back({{"model", finding.model},
                      {"check", finding.check},
                      {"verdict", name_of(kVerdicts, finding.verdict)},
                      {"words", finding.words}});
    const remap::Json json = {
        {"renderer", worker.description().renderer}, {"wrong", wrong}, {"findings", list}};
    std::cout << json.dump(2) << "\n";
  } else {
    std::cout << worker.description().renderer << "\n";
    print(findings);
  }
  if (wrong != 0)
    throw input_error("worker " + check.command + ": " + std::to_string(wrong) + " of " +
                      std::to_string(findings.size()) + " checks failed");
}

}  // namespace

void add_worker_check_command(remap::Command& app) {
  remap::Command* command = app.add_subcommand(
      "worker-check", "Render known scenes with a worker and report what is wrong with its pictures",
      kRendererStage);
  WorkerCheck& options = set_work<WorkerCheck>(*command, run);
  command->add_option("command", options.command, "Command of the worker, or the name of a registered one")
      ->required();
  command->option_group("Pictures");
  command->add_option("--resolution", options.resolution, "Width and height in pixels")->range(16, 1024);
  command->add_option("--worker-timeout", options.limits.seconds, "Seconds to wait for an answer")
      ->positive();
  command->option_group("Output");
  command->add_flag("--json", options.json, "Print the findings as JSON to standard output");
  command->footer("Example:\n  remapc worker-check \"python3 examples/lambert_worker.py\"");
}

}  // namespace remapc
