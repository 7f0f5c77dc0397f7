// This file describes a part of a shared conversion, and the paths of its journal and report.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace remap {

// These are names in an output folder. A run over all sets has the journal kJournalName (journal.hpp). Parts
// have the folder kPartsFolder, with a journal and a report (`part-0012-of-0400.jsonl`) for each part.
inline constexpr const char* kJournalName = ".texremap.jsonl";
inline constexpr const char* kPartsFolder = ".texremap-parts";
inline constexpr const char* kPartJournal = ".journal";
inline constexpr const char* kPartReport = ".jsonl";

// A Part is part `index` of `count`, counted from 1. Each part of a manifest has successive sets, and all
// parts cost about the same.
struct Part {
  std::size_t index = 1, count = 1;
  std::string note = {};  // what was understood from the environment
};

// Converts a part to `part-0012-of-0400`, and back. Returns nothing for other names.
std::string name_of(const Part& part);
std::optional<Part> part_named(const std::string& name);

// Reads `12/400`, `auto` or `auto/400`. With `auto`, the environment must hold the number of this job and the
// size of the array of jobs. `auto/400` needs only the number of this job. Throws kUsage, with the name of
// the missing value.
Part part_of(const std::string& word, const std::function<const char*(const char* name)>& environment);

}  // namespace remap
