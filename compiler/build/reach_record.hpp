// This file reads how close a folder's converters come to the best match, as `remap-study reach` measured it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

namespace remap {

inline constexpr const char* kReachName = "reach.csv";

// A ReachRecord is the record of one fit. Excesses are fractions of the source's picture (study/reach.hpp).
struct ReachRecord {
  std::string fit;            // SHA-256 of its file
  std::size_t materials = 0;  // number of compared materials
  double mean_excess = 0.0, largest_excess = 0.0;
  double alpha = 0.0, specular = 0.0;  // excesses of the material with the largest excess
};
using ReachRecords = std::map<std::string, ReachRecord>;  // keyed by id

// Reads the records in `folder`, or none if their file does not exist. Throws kInput if the file has another
// form.
ReachRecords read_reach(const std::filesystem::path& folder);
// Returns the records of fits that are unchanged since they were measured.
ReachRecords current_reach(const std::filesystem::path& folder);
void write_reach(const std::filesystem::path& folder, const ReachRecords& records);

}  // namespace remap
