// This file checks the input paths of a user, and suggests what to do about files that texremap cannot read.
#pragma once

#include <filesystem>
#include <vector>

namespace remap {

// Throws kUsage, with the format and the advice, for a file of a format that other tools use.
void require_readable(const std::filesystem::path& path);

// Throws kUsage for paths that are neither one folder nor only assets.
void require_one_kind(const std::filesystem::path& first, const std::vector<std::filesystem::path>& more);

}  // namespace remap
