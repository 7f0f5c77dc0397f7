// The fits of a folder, for the commands that work on all of them.
#pragma once

#include <filesystem>
#include <vector>

#include "model/fit.hpp"

namespace remapc {

// Every `*.json` of `folder` but its manifest as a fit, in the order of ids. Throws kInput for a folder that
// cannot be read, a file that is no fit, and a file whose name is not its id.
std::vector<remap::Fit> load_fits(const std::filesystem::path& folder);

// The fit that `name` means: a file, or an id in `folder`. Throws kUsage with the nearest known id.
remap::Fit find_fit(const std::string& name, const std::filesystem::path& folder);

}  // namespace remapc
