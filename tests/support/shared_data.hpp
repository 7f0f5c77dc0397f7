// This file finds real data in a folder next to the repository, if it exists.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "support/skip.hpp"

namespace remap {

// Returns the path of `name` in the folder of shared data: REMAP_SHARED_DATA, or ../shared/data next to the
// source tree. If it is missing, it returns an empty path, and the test is reported as skipped.
inline std::filesystem::path shared_data(const std::string& name) {
  may_skip();
  const char* given = std::getenv("REMAP_SHARED_DATA");
  const std::filesystem::path folder =
      given != nullptr ? std::filesystem::path(given)
                       : std::filesystem::path(REMAP_SOURCE_DIR) / ".." / "shared" / "data";
  const std::filesystem::path path = folder / name;
  if (std::filesystem::exists(path)) return path;
  skip("shared-data", name + " is not in " + folder.lexically_normal().string());
  return {};
}

}  // namespace remap
