#include "table/domain.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "lower/chain.hpp"

namespace remap {
namespace {

// If alpha1 has at most this many different values, each value is a column. Otherwise neighbours share a
// column until it has kRowsAColumn rows.
constexpr std::size_t kMostColumns = 128;
constexpr std::size_t kRowsAColumn = 64;
// If rows are scattered, a column is complete if it ends within this fraction of the highest specular1.
constexpr double kSameReach = 0.9;
// Widths that differ by less than this fraction, a few units of a table's last digit, are treated as one.
constexpr double kSameWidth = 1e-9;

std::map<double, std::size_t> column_of_alpha(const Table& table) {
  std::map<double, std::size_t> rows_of_alpha;
  for (const TableRow& row : table.rows) ++rows_of_alpha[row.alpha1];
  const bool own_columns = rows_of_alpha.size() <= kMostColumns;
  std::map<double, std::size_t> column_of;
  std::size_t column = 0, filled = 0;
  for (const auto& [alpha, rows] : rows_of_alpha) {
    column_of[alpha] = column;
    filled += rows;
    if (!own_columns && filled < kRowsAColumn) continue;
    ++column;
    filled = 0;
  }
  return column_of;
}

// Returns columns of rows of similar width. A column reaches to the highest usable specular1 below its cut,
// the lowest specular1 that is clamped without an answer.
std::vector<CoveredColumn> columns_of(const Table& table) {
  const std::map<double, std::size_t> column_of = column_of_alpha(table);
  if (column_of.empty()) return {};
  std::vector<CoveredColumn> columns(column_of.rbegin()->second + 1, {INFINITY, -INFINITY, 0.0, false});
  std::vector<double> cuts(columns.size(), INFINITY);
  for (const TableRow& row : table.rows) {
    double& cut = cuts[column_of.at(row.alpha1)];
    if (row.status == RowStatus::kClamped) cut = std::min(cut, row.specular1);
  }
  double highest = 0.0;
  for (const TableRow& row : table.rows) {
    const std::size_t at = column_of.at(row.alpha1);
    CoveredColumn& column = columns[at];
    if (!has_answer(row) || row.specular1 >= cuts[at]) continue;
    column.first = std::min(column.first, row.alpha1);
    column.last = std::max(column.last, row.alpha1);
    column.reach = std::max(column.reach, row.specular1);
    highest = std::max(highest, column.reach);
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (std::isfinite(cuts[i])) continue;
    if (columns[i].reach >= kSameReach * highest) columns[i].reach = highest;
    columns[i].is_gap = columns[i].reach == 0.0;
  }
  return columns;
}

// Replaces widths that differ only by rounding of the measurement by the least of them, so that they form one
// column.
void join_widths(std::vector<TableRow>& rows) {
  std::map<double, double> joined;
  for (const TableRow& row : rows) joined[row.alpha1] = row.alpha1;
  double first = 0.0;
  for (auto& [width, name] : joined) {
    if (width - first > kSameWidth * width) first = width;
    name = first;
  }
  for (TableRow& row : rows) row.alpha1 = joined.at(row.alpha1);
}

}  // namespace

Domain table_domain(const Table& table) {
  const auto domain = covered_box(columns_of(table));
  if (!domain) throw input_error(table.name + ": no width has usable rows (rows of status ok are needed)");
  return *domain;
}

std::string range_text(const Range& range) {
  return number_text(range.min) + " to " + number_text(range.max);
}

Table swapped(const Table& table) {
  Table result = table;
  std::erase_if(result.comments, [](const auto& comment) {
    return comment.first == kSpheresComment || comment.first == kAlphaLimitComment ||
           comment.first == kSpecularLimitComment;
  });
  result.comments.emplace_back("roles", "swapped");
  std::swap(result.source, result.target);
  result.limits = {};
  std::erase_if(result.rows, [](const TableRow& row) { return row.status != RowStatus::kOk; });
  for (TableRow& row : result.rows) {
    std::swap(row.alpha1, row.alpha2);
    std::swap(row.specular1, row.specular2);
  }
  join_widths(result.rows);
  return result;
}

}  // namespace remap
