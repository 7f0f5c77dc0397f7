// What a fit records of its table, and the hash that identifies a file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/fit.hpp"

namespace remapc {

// What a fit says of the table that it was made from, whose file is `bytes`.
remap::TableRecord table_record(const std::filesystem::path& path, std::string_view bytes,
                                const std::vector<std::pair<std::string, std::string>>& comments);

// SHA-256 (FIPS 180-4) of `bytes` as 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace remapc
