// The paths that a user names as inputs: what texremap cannot read, and the way around.
#pragma once

#include <filesystem>
#include <vector>

namespace remap {

// Throws kUsage, naming the format and the way around, for a file of a format that other tools use.
void require_readable(const std::filesystem::path& path);

// Throws kUsage for paths that are not one folder, or assets alone.
void require_one_kind(const std::filesystem::path& first, const std::vector<std::filesystem::path>& more);

}  // namespace remap
