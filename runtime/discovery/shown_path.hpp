// Paths in messages: a file name may hold any byte, and a message is one line.
#pragma once

#include <filesystem>
#include <string>

namespace remap {

// The path with control characters escaped, as in `\n` and `\x1b`; other bytes as they are.
std::string shown(const std::filesystem::path& path);

}  // namespace remap
