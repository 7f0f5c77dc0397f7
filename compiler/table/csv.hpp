// CSV as tables of this project are written: comments, a header row, rows of as many cells, each with its
// place.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace remapc {

// A field of a line with its place, 1-based, for messages.
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

  // The value of a comment, empty where there is none.
  std::string comment(const std::string& key) const;

  // Throws kInput: `name:line:column: what`.
  [[noreturn]] void fail(std::size_t line, std::size_t column, const std::string& what) const;

  // The number in a cell of `line`, which is called `column_name` in the complaint where it is none.
  double number(const CsvLine& line, const CsvCell& cell, const std::string& column_name) const;
};

// Fields of one line.
std::vector<CsvCell> split_csv_line(std::string_view line, char delimiter);

// Reads UTF-8 text, with comma, tab or semicolon (whichever the header row has most). Cells point into
// `text`. Throws kInput for text without a header row or rows, and for a row of another length.
Csv parse_csv(std::string_view text, const std::string& name);

}  // namespace remapc
