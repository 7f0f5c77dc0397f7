// This file reads and writes tables. Commands write plain CSV, which numpy, pandas and spreadsheets read
// without options. FILE.json beside it records how the table was made (decision 052). Tables with comments
// can be read, too.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "table/csv.hpp"

namespace remap {

// Returns the SHA-256 (FIPS 180-4) of `bytes` as 64 hexadecimal digits.
std::string sha256(std::string_view bytes);
// Returns the SHA-256 of a file, or an empty text if the file is missing.
std::string file_sha256(const std::filesystem::path& path);

// Parses a JSON object of texts about the table `table`. Throws kInput, beginning with `context`.
Comments parse_metadata(std::string_view json, const std::string& context);

// Parses the content of the file `path` (parse_csv). A table without comments gets the comments of FILE.json.
Csv parse_table_file(std::string_view bytes, const std::filesystem::path& path);

// Returns the table as one text, with its comments. Fits record the hash of this text, so both forms of a
// table have the same hash.
std::string whole_text(const Csv& csv, std::string_view bytes);

// Throws kOutput if the table or its FILE.json exists already, unless `force`.
void require_new_table(const std::filesystem::path& path, bool force);

// Writes CSV text as a plain file, and its comments, if it has some, as FILE.json.
void write_plain_table(const std::filesystem::path& path, std::string_view text);

}  // namespace remap
