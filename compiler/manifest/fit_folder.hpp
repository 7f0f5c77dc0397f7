// The fits of a folder, for the commands that work on all of them.
#pragma once

#include <filesystem>
#include <vector>

#include "fit_file/any_fit.hpp"

namespace remapc {

// Both in the order of ids.
struct FitFolder {
  std::vector<remap::Fit> fits;  // of width and specular
  std::vector<remap::WorkflowFit> analytic;
  std::vector<remap::WarpMapFit> warps;
};

// Every `*.json` of `folder` but its manifest as a fit. Throws kInput for a folder that cannot be read, a
// file that is no fit, and a file whose name is not its id.
FitFolder load_fit_folder(const std::filesystem::path& folder);

// Those of width and specular alone.
std::vector<remap::Fit> load_fits(const std::filesystem::path& folder);

// The fit that `name` means: a file, or an id in `folder`. Throws kUsage with the nearest known id.
remap::AnyFit find_any_fit(const std::string& name, const std::filesystem::path& folder);

// The same for what needs a fit of width and specular. Throws kUsage for an analytic one.
remap::Fit find_fit(const std::string& name, const std::filesystem::path& folder);

}  // namespace remapc
