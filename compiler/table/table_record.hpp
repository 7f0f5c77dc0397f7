// The record of a table in its fit, and the hash that identifies a file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "remap/fit.hpp"

namespace remapc {

// Returns what a fit records of its table, whose file is `bytes`.
remap::TableRecord table_record(const std::filesystem::path& path, std::string_view bytes,
                                const std::vector<std::pair<std::string, std::string>>& comments);

// Returns the SHA-256 (FIPS 180-4) of `bytes` as 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace remapc
