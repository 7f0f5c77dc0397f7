// Paths in messages. A file name may hold any byte, but a message must be one line.
#pragma once

#include <filesystem>
#include <string>

namespace remap {

// The path with control characters escaped, such as `\n` and `\x1b`. Other bytes are unchanged.
std::string shown(const std::filesystem::path& path);

}  // namespace remap
