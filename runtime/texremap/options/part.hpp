// A part of a conversion that many processes share, and the paths of its journal and report.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace remap {

// In an output folder: the journal of a run of all sets (journal.hpp), and the folder of the parts with a
// journal and a report (`part-0012-of-0400.jsonl`) of each.
inline constexpr const char* kJournalName = ".texremap.jsonl";
inline constexpr const char* kPartsFolder = ".texremap-parts";
inline constexpr const char* kPartJournal = ".journal";
inline constexpr const char* kPartReport = ".jsonl";

// Part `index` of `count`, from 1. The parts of a manifest are runs of neighbouring sets of about equal cost.
struct Part {
  std::size_t index = 1, count = 1;
  bool operator==(const Part&) const = default;
};

// `part-0012-of-0400`, and back; none for another name.
std::string name_of(const Part& part);
std::optional<Part> part_named(const std::string& name);

// A part as the command line gives it.
struct GivenPart {
  Part part;
  std::string note;  // what was understood, where the environment told it
};

// Reads `12/400`; `auto`, where the environment has the place in an array of jobs and its size; `auto/400`,
// where it has the place alone. Throws kUsage, naming what is missing.
GivenPart part_of(const std::string& word, const std::function<const char*(const char* name)>& environment);

}  // namespace remap
