// Which workers there are: those of the command line, the user's own, those that ship.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "worker/worker.hpp"

namespace remapc {

// The workers of a JSON file (compiler/adapters/PROTOCOL.md, last section). Throws kInput.
std::vector<WorkerEntry> read_worker_list(const std::filesystem::path& path);

// `NAME=COMMAND`, as given on the command line. Throws kUsage.
WorkerEntry parse_worker(const std::string& text);

// All of them, in the order of their names; of one name the first of: `given`, the user's own list, the
// shipped list. Throws kInput for a list that cannot be read, kUsage for what is given.
std::vector<WorkerEntry> known_workers(const std::vector<std::string>& given);

}  // namespace remapc
