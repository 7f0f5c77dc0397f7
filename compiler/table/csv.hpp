// Reads the CSV tables of this project: comments, a header row and rows of as many cells. Each cell knows its
// place.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace remapc {

// One cell of a line with its place, for messages.
struct CsvCell {
  std::string_view text;
  std::size_t column = 1;
};

struct CsvLine {
  std::size_t number = 0;  // in the file, 1-based
  std::vector<CsvCell> cells;
};

struct Csv {
  std::string name;                                           // for messages
  std::vector<std::pair<std::string, std::string>> comments;  // `# key: value`, in file order
  CsvLine header;
  std::vector<CsvLine> lines;

  // Returns the value of a comment; empty if there is no such comment.
  std::string comment(const std::string& key) const;

  // Throws kInput: `name:line:column: what`.
  [[noreturn]] void fail(std::size_t line, std::size_t column, const std::string& what) const;

  // Returns the number in a cell of `line`. The error message calls the cell `column_name`.
  double number(const CsvLine& line, const CsvCell& cell, const std::string& column_name) const;
};

// Splits one line into its cells.
std::vector<CsvCell> split_csv_line(std::string_view line, char delimiter);

// Parses UTF-8 text delimited by comma, tab or semicolon, whichever occurs most in the header row. Cells
// point into `text`. Throws kInput for text without a header row or without rows, and for a row of another
// length.
Csv parse_csv(std::string_view text, const std::string& name);

}  // namespace remapc
