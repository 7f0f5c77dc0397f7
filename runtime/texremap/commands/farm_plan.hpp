// This file writes files that hand a conversion in parts to a scheduler.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "remap/model.hpp"

namespace remap {

enum class PlanKind { kSlurm, kOpenJd, kCommands };
inline constexpr NamedValues<PlanKind, 3> kPlanKinds = {
    {{PlanKind::kSlurm, "slurm"}, {PlanKind::kOpenJd, "openjd"}, {PlanKind::kCommands, "commands"}}};

// A PlannedFarm is a conversion in parts, with the needs of each part.
struct PlannedFarm {
  std::string program;                                   // texremap, as the jobs call it
  std::filesystem::path manifest, tree, output, folder;  // absolute paths; `folder` is where the plan lies
  std::filesystem::path report;                          // of all parts, in `folder`
  std::vector<std::string> options;                      // options of convert, except the paths above
  std::size_t parts = 1;
  unsigned threads = 1;      // threads of each part; 0: as many as its machine has cores
  int memory_megabytes = 0;  // memory of each part
  int minutes = 0;           // time limit of each part
};

// Throws kUsage for words that the files of a plan cannot hold. For example, a line break in a word would
// begin a new line of the script.
void require_writable(PlanKind kind, const PlannedFarm& farm);

// Returns the files of a plan, each with its name and its text.
std::vector<std::pair<std::string, std::string>> plan_files(PlanKind kind, const PlannedFarm& farm);
// Returns the shell command that submits the files of a plan.
std::string submit_command(PlanKind kind, const PlannedFarm& farm);

}  // namespace remap
