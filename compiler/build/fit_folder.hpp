// This file loads the fits of a folder, and how close they come to the best match, as `remap-study reach`
// measured it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "lower/fit_file.hpp"

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

struct FitFolder {
  std::vector<Fit> fits;  // converters of width and specular
  std::vector<WorkflowFit> workflows;
  std::vector<WarpMapFit> warps;
  ReachRecords reach;  // only for fits that are unchanged since they were measured

  void add(AnyFit fit);
};

// Returns the default folder of fits. This is `fits` in the working directory if it has any fit, otherwise
// the installed folder. If neither exists, returns `fits`.
std::filesystem::path default_fit_folder();

// Loads every `*.json` directly in `folder`, except for its manifest and the records of tables
// (`*.csv.json`). Throws kInput for a folder that cannot be read, for a file without a fit, and for a file
// whose name is not the id of its fit.
FitFolder load_fit_folder(const std::filesystem::path& folder);

// Loads the converters of width and specular only.
std::vector<Fit> load_fits(const std::filesystem::path& folder);

// Loads the fit that `name` means: a file, or an id in `folder`. If there is none, throws kUsage with the
// closest id.
AnyFit find_any_fit(const std::string& name, const std::filesystem::path& folder);

// Loads the fit for commands that need a converter of width and specular. Throws kUsage for other kinds.
Fit find_fit(const std::string& name, const std::filesystem::path& folder);

}  // namespace remap
