// Files that hand a conversion in parts to a scheduler.
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

// A conversion in parts, and what each part needs.
struct PlannedFarm {
  std::string program;                                   // texremap, as the jobs call it
  std::filesystem::path manifest, tree, output, folder;  // absolute; of the plan itself last
  std::vector<std::string> options;                      // of convert, without the above
  std::size_t parts = 1;
  unsigned threads = 1;      // of a part; 0 for all of its machine
  int memory_megabytes = 0;  // of a part
  int minutes = 0;           // that a part may take
};

// Throws kUsage for words that the files of a plan cannot hold: a line break would begin a line of a script.
void require_writable(PlanKind kind, const PlannedFarm& farm);

// The files of a plan, by their names, and the line of a shell that submits them.
struct PlanFiles {
  std::vector<std::pair<std::string, std::string>> files;
  std::string submit;
};
PlanFiles plan_files(PlanKind kind, const PlannedFarm& farm);

}  // namespace remap
