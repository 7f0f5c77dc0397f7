// Tables as files. What commands write is plain CSV, which numpy, pandas and spreadsheets read without
// options; how it was made is beside it, in FILE.json (decision 052). Files with comments are read as well.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "table/csv.hpp"

namespace remap {

// Returns the SHA-256 (FIPS 180-4) of `bytes` as 64 hexadecimal digits.
std::string sha256(std::string_view bytes);
// The text of a file; empty if it is missing.
std::string file_sha256(const std::filesystem::path& path);

// Parses what a JSON object of texts says of the table `table`. Throws kInput, beginning with `context`.
Comments parse_metadata(std::string_view json, const std::string& context);

// Parses the content of the file `path` (parse_csv). A table without comments has those of FILE.json.
Csv parse_table_file(std::string_view bytes, const std::filesystem::path& path);

// The table in one text, with its comments: fits record its hash, which is the same in both forms.
std::string whole_text(const Csv& csv, std::string_view bytes);

// Throws kOutput where the table or its FILE.json is there already, unless `force`.
void require_new_table(const std::filesystem::path& path, bool force);

// Writes CSV text as a plain file, and its comments, if it has some, as FILE.json.
void write_plain_table(const std::filesystem::path& path, std::string_view text);

}  // namespace remap
