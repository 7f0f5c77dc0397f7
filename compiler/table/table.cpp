#include "table/table.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "error.hpp"
#include "files.hpp"
#include "nearest_name.hpp"
#include "number_text.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

constexpr std::array kStatuses = {RowStatus::kOk, RowStatus::kClamped, RowStatus::kFlat,
                                  RowStatus::kUnstable};
const std::array<std::string, 8> kColumns = {"alpha1",   "specular1", "alpha2", "specular2",
                                             "diffuse1", "diffuse2",  "error",  "status"};
constexpr std::size_t kRequiredColumns = 4;
constexpr std::size_t kDiffuse1 = 4, kDiffuse2 = 5, kError = 6, kStatus = 7;

// A field of a line with its place, 1-based, for messages.
struct Cell {
  std::string_view text;
  std::size_t column = 1;
};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '"')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '"' || text.back() == '\r'))
    text.remove_suffix(1);
  return text;
}

std::vector<Cell> split_line(std::string_view line, char delimiter) {
  std::vector<Cell> cells;
  std::size_t start = 0;
  for (;;) {
    const std::size_t end = std::min(line.find(delimiter, start), line.size());
    cells.push_back({trimmed(line.substr(start, end - start)), start + 1});
    if (end == line.size()) return cells;
    start = end + 1;
  }
}

// The delimiter that splits the header row into most cells; comma where there is none.
char detect_delimiter(std::string_view header) {
  char best = ',';
  std::size_t most = 0;
  for (const char candidate : {',', '\t', ';'}) {
    const auto count = static_cast<std::size_t>(std::count(header.begin(), header.end(), candidate));
    if (count > most) {
      best = candidate;
      most = count;
    }
  }
  return best;
}

// Reads one table; a class so that every complaint can name the place.
class Reader {
 public:
  Reader(std::string_view text, const std::string& name, const ColumnMap& map) : text_(text), map_(map) {
    table_.name = name;
  }

  Table read() {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);  // byte order mark
    std::string_view line;
    while (next_line(&line) && !read_preamble(line)) {
    }
    if (places_.empty())
      throw Error(ErrorKind::kInput, table_.name + ": has no header row; expected a CSV table");
    while (next_line(&line))
      if (!trimmed(line).empty()) read_row(line);
    if (table_.rows.empty()) fail(1, "the table has no rows");
    table_.source = side("source", map_.source);
    table_.target = side("target", map_.target);
    return std::move(table_);
  }

 private:
  [[noreturn]] void fail(std::size_t column, const std::string& what) const {
    throw Error(ErrorKind::kInput, table_.name + ":" + std::to_string(line_number_) + ":" +
                                       std::to_string(column) + ": " + what);
  }

  bool next_line(std::string_view* line) {
    if (text_.empty()) return false;
    const std::size_t end = text_.find('\n');
    *line = text_.substr(0, end);
    text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
    ++line_number_;
    return true;
  }

  // Takes a comment or, as the last line before the rows, the header. True after the header.
  bool read_preamble(std::string_view line) {
    if (trimmed(line).empty()) return false;
    if (line.front() == '#') {
      const std::size_t colon = line.find(": ");
      if (colon != std::string_view::npos)
        table_.comments.emplace_back(trimmed(line.substr(1, colon - 1)), trimmed(line.substr(colon + 2)));
      return false;
    }
    read_header(line);
    return true;
  }

  void read_header(std::string_view line) {
    delimiter_ = detect_delimiter(line);
    const std::vector<Cell> cells = split_line(line, delimiter_);
    cell_count_ = cells.size();
    places_.assign(kColumns.size(), kMissing);
    std::vector<std::string> found;
    for (const Cell& cell : cells) found.emplace_back(cell.text);
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      const auto renamed = map_.columns.find(kColumns[i]);
      const std::string& wanted = renamed == map_.columns.end() ? kColumns[i] : renamed->second;
      for (std::size_t j = 0; j < cells.size(); ++j)
        if (cells[j].text == wanted) places_[i] = j;
      if (places_[i] != kMissing || i >= kRequiredColumns) continue;
      if (cells.size() == 1)
        fail(1, "the header row is one column, \"" + found[0] +
                    "\"; expected columns parted by comma, tab or semicolon");
      fail(1, "has no column " + wanted + remap::suggestion(wanted, found));
    }
    const bool source = places_[kDiffuse1] != kMissing, target = places_[kDiffuse2] != kMissing;
    if (source != target)
      fail(1, "has a column " + kColumns[source ? kDiffuse1 : kDiffuse2] + " but no " +
                  kColumns[source ? kDiffuse2 : kDiffuse1] + "; expected both or neither");
    table_.has_diffuse = source;
  }

  double number(const Cell& cell, const std::string& name) const {
    const auto value = remap::parse_number(cell.text);
    if (!value) fail(cell.column, name + " is \"" + std::string(cell.text) + "\"; expected a number");
    return *value;
  }

  RowStatus status(const Cell& cell) const {
    for (const RowStatus status : kStatuses)
      if (status_name(status) == cell.text) return status;
    fail(cell.column, "status is \"" + std::string(cell.text) + "\"; expected ok, clamped, flat or unstable");
  }

  void read_row(std::string_view line) {
    const std::vector<Cell> cells = split_line(line, delimiter_);
    if (cells.size() != cell_count_)
      fail(1, "the row has " + std::to_string(cells.size()) + " columns; expected " +
                  std::to_string(cell_count_) + " as in the header");
    TableRow row;
    row.line = line_number_;
    row.alpha1 = number(cells[places_[0]], kColumns[0]);
    row.specular1 = number(cells[places_[1]], kColumns[1]);
    row.alpha2 = number(cells[places_[2]], kColumns[2]);
    row.specular2 = number(cells[places_[3]], kColumns[3]);
    if (table_.has_diffuse) {
      row.diffuse1 = number(cells[places_[kDiffuse1]], kColumns[kDiffuse1]);
      row.diffuse2 = number(cells[places_[kDiffuse2]], kColumns[kDiffuse2]);
    }
    row.error = places_[kError] == kMissing ? std::numeric_limits<double>::quiet_NaN()
                                            : number(cells[places_[kError]], kColumns[kError]);
    if (places_[kStatus] != kMissing) row.status = status(cells[places_[kStatus]]);
    table_.rows.push_back(row);
  }

  std::string comment(const std::string& key) const {
    for (const auto& [name, value] : table_.comments)
      if (name == key) return value;
    return "";
  }

  remap::ModelSide side(const std::string& role, const remap::ModelSide& given) const {
    if (!given.model.empty()) return given;
    remap::ModelSide side;
    side.model = comment(role);
    if (const std::string text = comment(role + "_roughness"); !text.empty()) {
      const auto convention = remap::convention_from_name(text);
      if (!convention)
        throw Error(ErrorKind::kInput, table_.name + ": " + role + "_roughness is \"" + text + "\"" +
                                           remap::suggestion(text, remap::convention_names()));
      side.roughness = *convention;
    }
    for (const char* suffix : {"_specular", "_specular_column"})
      if (const std::string text = comment(role + suffix); !text.empty()) side.specular = text;
    return side;
  }

  static constexpr std::size_t kMissing = std::numeric_limits<std::size_t>::max();

  std::string_view text_;
  const ColumnMap& map_;
  Table table_;
  std::size_t line_number_ = 0;
  char delimiter_ = ',';
  std::size_t cell_count_ = 0;
  std::vector<std::size_t> places_;  // for each of kColumns, its cell in a row
};

}  // namespace

std::string_view status_name(RowStatus status) {
  switch (status) {
    case RowStatus::kOk:
      return "ok";
    case RowStatus::kClamped:
      return "clamped";
    case RowStatus::kFlat:
      return "flat";
    case RowStatus::kUnstable:
      return "unstable";
  }
  return "ok";
}

ColumnMap column_map(const std::string& text) {
  ColumnMap map;
  if (text == "sztrajman-2019") {
    map.columns = {{"specular2", "eta2"}};
    map.source = {"mitsuba/ward", remap::RoughnessConvention::kAlpha, "specular"};
    map.target = {"mitsuba/as", remap::RoughnessConvention::kAlpha, "f0"};
    return map;
  }
  if (text.find('=') == std::string::npos) {
    const std::vector<std::string> presets = {"sztrajman-2019"};
    throw Error(ErrorKind::kUsage, "columns: " + text + " is neither a preset nor own=file pairs" +
                                       remap::suggestion(text, presets));
  }
  for (const Cell& cell : split_line(text, ',')) {
    const std::size_t equals = cell.text.find('=');
    const std::string own(cell.text.substr(0, equals));
    if (equals == std::string_view::npos ||
        std::find(kColumns.begin(), kColumns.end(), own) == kColumns.end())
      throw Error(ErrorKind::kUsage, "columns: \"" + std::string(cell.text) + "\"; expected own=file" +
                                         remap::suggestion(own, kColumns));
    map.columns[own] = std::string(cell.text.substr(equals + 1));
  }
  return map;
}

Table parse_table(std::string_view text, const std::string& name, const ColumnMap& map) {
  return Reader(text, name, map).read();
}

Table read_table(const std::filesystem::path& path, const ColumnMap& map) {
  return parse_table(remap::read_file(path), path.string(), map);
}

std::string row_text(const TableRow& row, bool has_diffuse) {
  std::string text;
  for (const double value : {row.alpha1, row.specular1, row.alpha2, row.specular2})
    text += remap::number_text(value) + ",";
  if (has_diffuse) text += remap::number_text(row.diffuse1) + "," + remap::number_text(row.diffuse2) + ",";
  return text + remap::number_text(row.error) + "," + std::string(status_name(row.status));
}

std::vector<TableRow> usable_rows(const Table& table) {
  std::vector<TableRow> rows;
  for (const TableRow& row : table.rows)
    if (row.status == RowStatus::kOk) rows.push_back(row);
  return rows;
}

bool is_inside(const TableRow& row, const remap::Domain& domain) {
  return domain.alpha.contains(row.alpha1) && domain.specular.contains(row.specular1);
}

std::vector<TableRow> rows_inside(const std::vector<TableRow>& rows, const remap::Domain& domain) {
  std::vector<TableRow> inside;
  for (const TableRow& row : rows)
    if (is_inside(row, domain)) inside.push_back(row);
  return inside;
}

std::string table_text(const Table& table) {
  std::string text;
  for (const auto& [key, value] : table.comments) text += "# " + key + ": " + value + "\n";
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    if (!table.has_diffuse && (i == kDiffuse1 || i == kDiffuse2)) continue;
    text += (i == 0 ? "" : ",") + kColumns[i];
  }
  text += "\n";
  for (const TableRow& row : table.rows) text += row_text(row, table.has_diffuse) + "\n";
  return text;
}

}  // namespace remapc
