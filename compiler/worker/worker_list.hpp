// Lists the known workers: those of the command line, the user's own, and those that ship.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "worker/worker.hpp"

namespace remapc {

// Reads the workers of a JSON file (compiler/adapters/PROTOCOL.md, last section). Throws kInput.
std::vector<WorkerEntry> read_worker_list(const std::filesystem::path& path);

// Parses `NAME=COMMAND` of the command line. Throws kUsage.
WorkerEntry parse_worker(const std::string& text);

// Returns all workers by name. Of workers with the same name the first counts, in the order `given`, the
// user's list, the shipped list. Throws kInput for a list that cannot be read, kUsage for errors in `given`.
std::vector<WorkerEntry> known_workers(const std::vector<std::string>& given);

}  // namespace remapc
