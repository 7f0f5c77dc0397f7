// This file reads and writes the CSV tables of this project: comments, a header row and rows of as many
// cells. A cell that was read knows its line and column. Commands write plain CSV, which numpy, pandas and
// spreadsheets read without options. FILE.json beside it records how the table was made (decision 052).
// Tables with comments can be read, too.
#pragma once

#include <concepts>
#include <filesystem>
#include <ranges>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace remap {

// Comments holds the lines `# key: value` of a table, in file order.
using Comments = std::vector<std::pair<std::string, std::string>>;

// Adds the content of the line `# key: value`.
void add_comment(std::string_view line, Comments* comments);

// A CsvCell is one cell of a line with its place, for messages.
struct CsvCell {
  std::string_view text;
  std::size_t column = 1;
};

struct CsvLine {
  std::size_t number = 0;  // line number in the file, from 1
  std::vector<CsvCell> cells;
};

// These limit the tables that are read to twice the size of the largest table of remapc sample. A million
// rows need 300 MB of memory while they are read.
inline constexpr std::size_t kMostCsvRows = 2'000'000, kMostCsvColumns = 1000, kMostCsvComments = 1000;
inline constexpr std::size_t kLongestCsvLine = 100'000, kLongestComment = 5000;  // both in bytes

struct Csv {
  std::string name;  // name for messages
  Comments comments;
  CsvLine header;
  std::vector<CsvLine> lines;
  std::vector<std::string> remarks;  // what was assumed, for the user

  // Returns the value of a comment, or an empty text if there is no such comment.
  std::string comment(const std::string& key) const;

  // Throws kInput: `name:line:column: what`.
  [[noreturn]] void fail(std::size_t line, std::size_t column, const std::string& what) const;

  // Returns the number in a cell of `line`. The error message calls the cell `column_name`.
  double number(const CsvLine& line, const CsvCell& cell, const std::string& column_name) const;
};

std::vector<CsvCell> split_csv_line(std::string_view line, char delimiter);

// Parses UTF-8 text delimited by comma, tab or semicolon, whichever occurs most in the header row. Cells
// point into `text`. Throws kInput for text without a header row or without rows, for a row of another
// length, for two columns of one name, and for text beyond the limits above.
Csv parse_csv(std::string_view text, const std::string& name);

// A CsvText is CSV text that is being written.
class CsvText {
 public:
  // `header` holds the names of the columns with commas between them.
  explicit CsvText(const std::string& header, const Comments& comments = {});

  // Adds a row of at least one cell. A cell is a text (quoted if it holds a comma) or a number (the shortest
  // text that reads back). A range gives one
  // cell for each element.
  template <typename... Cells>
  void add_row(const Cells&... cells) {
    (add(cells), ...);
    text_.back() = '\n';
  }

  const std::string& text() const { return text_; }

 private:
  void add(std::string_view cell);
  void add(double number);
  void add(std::size_t number) { add(static_cast<double>(number)); }
  template <std::ranges::range Numbers>
  requires(!std::convertible_to<Numbers, std::string_view>) void add(const Numbers& numbers) {
    for (const auto& number : numbers) add(number);
  }

  std::string text_;
};

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
