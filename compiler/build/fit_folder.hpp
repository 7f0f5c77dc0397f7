// This file loads the fits of a folder.
#pragma once

#include <filesystem>
#include <vector>

#include "build/reach_record.hpp"
#include "lower/fit_file.hpp"

namespace remap {

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
