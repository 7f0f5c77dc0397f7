#include "table/regression.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "lower/chain.hpp"
#include "lower/interpreter.hpp"

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

constexpr double kSmallestSpread = 2e-4;  // a smaller spread of alpha is not visible
constexpr double kTimesScatter = 2.0;
constexpr std::size_t kFewestRows = 10;

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

std::vector<std::size_t> seeded_order(std::size_t count, std::uint64_t seed) {
  // This is a Fisher-Yates shuffle, because std::shuffle differs between standard libraries.
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 random(seed);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

Split split_record(std::uint64_t seed, double fraction, std::size_t rows) {
  if (!(fraction >= 0.0 && fraction <= 0.9))
    throw usage_error("--held-out: " + number_text(fraction) + " is out of range (0 to 0.9)");
  Split record;
  record.seed = seed;
  record.held_out_fraction = fraction;
  record.held_out_rows = std::lround(fraction * static_cast<double>(rows));
  record.trained_rows = static_cast<std::int64_t>(rows) - record.held_out_rows;
  return record;
}

RowSplit split_rows(const Table& table, const Domain& domain, std::uint64_t seed, double held_out_fraction) {
  std::vector<const TableRow*> usable;
  std::map<std::string, std::int64_t> left_out;
  for (const TableRow& row : table.rows) {
    if (!has_answer(row))
      ++left_out[std::string(status_name(row.status))];
    else if (!is_inside(row, domain))
      ++left_out["beyond the domain"];
    else
      usable.push_back(&row);
  }
  RowSplit split;
  split.record = split_record(seed, held_out_fraction, usable.size());
  split.record.left_out = std::move(left_out);
  std::vector<std::size_t> order = seeded_order(usable.size(), seed);
  const auto count = static_cast<std::size_t>(split.record.held_out_rows);
  std::sort(order.begin(), order.begin() + split.record.held_out_rows);
  std::sort(order.begin() + split.record.held_out_rows, order.end());
  for (std::size_t i = 0; i < order.size(); ++i)
    (i < count ? split.held_out : split.training).push_back(*usable[order[i]]);
  return split;
}

Residuals residuals_of(const std::vector<TableRow>& rows,
                       const std::function<MappedTexel(double alpha, double specular)>& map) {
  Residuals errors;
  for (const TableRow& row : rows) {
    const MappedTexel texel = map(row.alpha1, row.specular1);
    errors.alpha.push_back(texel.alpha - row.alpha2);
    errors.specular.push_back(texel.specular - row.specular2);
  }
  return errors;
}

Residuals residuals_of(const std::vector<TableRow>& rows, const Fit& fit) {
  return residuals_of(rows,
                      [&](double alpha, double specular) { return evaluate_fit(fit, alpha, specular); });
}

Residuals residuals_of(const std::vector<TableRow>& rows, const MappingKind& mapping) {
  return residuals_of(
      rows, [&](double alpha, double specular) { return evaluate_mapping(mapping, alpha, specular); });
}

ErrorFigures error_figures(std::vector<double> errors) {
  if (errors.empty()) return {};
  double sum = 0.0;
  for (double& error : errors) {
    error = std::fabs(error);
    sum += error * error;
  }
  std::ranges::sort(errors);
  const auto rank = static_cast<std::size_t>(std::ceil(0.99 * static_cast<double>(errors.size())));
  return {std::sqrt(sum / static_cast<double>(errors.size())), errors[rank - 1], errors.back()};
}

std::string error_text(double error) {
  if (error == 0.0) return "0";
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), rounded_up(error, 2),
                                 std::chars_format::scientific, 1)
                       .ptr;
  return std::string(buffer.data(), end);
}

std::vector<TableRow> draw_rows(const std::vector<TableRow>& rows, std::size_t count, std::uint64_t seed) {
  if (rows.size() <= count) return rows;
  std::vector<std::size_t> order = seeded_order(rows.size(), seed);
  order.resize(count);
  std::ranges::sort(order);
  std::vector<TableRow> drawn;
  for (const std::size_t i : order) drawn.push_back(rows[i]);
  return drawn;
}

FitProgress part_of(const FitProgress& progress, double begin, double end) {
  if (!progress) return {};
  return [&progress, begin, end](double share) { progress(begin + (end - begin) * share); };
}

void require_variety(const std::vector<TableRow>& rows, const std::string& kind) {
  if (rows.size() < kFewestRows)
    throw input_error(kind + ": too few rows (" + std::to_string(rows.size()) + ", at least " +
                      std::to_string(kFewestRows) + " are required)");
  const auto require = [&](double TableRow::*input, const std::string& name) {
    const double first = rows.front().*input;
    if (std::ranges::all_of(rows, [&](const TableRow& row) { return row.*input == first; }))
      throw input_error(kind + ": " + name + " is " + number_text(first) +
                        " in every row (at least two values are required)");
  };
  require(&TableRow::alpha1, "alpha1");
  require(&TableRow::specular1, "specular1");
}

bool alpha_needs_specular(const std::vector<TableRow>& rows) {
  std::map<double, std::vector<const TableRow*>> by_alpha;
  for (const TableRow& row : rows) by_alpha[row.alpha1].push_back(&row);
  // At each alpha1, a straight line over specular is fitted. These are sums over all lines. `explained` is
  // what the lines explain, and `left` are their squared residuals.
  double explained = 0.0, left = 0.0, degrees = 0.0, count = 0.0;
  for (const auto& [alpha, group] : by_alpha) {
    if (group.size() < 3) continue;
    const auto size = static_cast<double>(group.size());
    double s = 0.0, a = 0.0;
    for (const TableRow* row : group) {
      s += row->specular1 / size;
      a += row->alpha2 / size;
    }
    double ss = 0.0, sa = 0.0, aa = 0.0;
    for (const TableRow* row : group) {
      ss += (row->specular1 - s) * (row->specular1 - s);
      sa += (row->specular1 - s) * (row->alpha2 - a);
      aa += (row->alpha2 - a) * (row->alpha2 - a);
    }
    if (ss <= 0.0) continue;
    explained += sa * sa / ss;
    left += std::max(0.0, aa - sa * sa / ss);
    degrees += size - 2.0;
    count += size;
  }
  if (count == 0.0 || degrees <= 0.0) return false;
  const double spread = std::sqrt(explained / count), scatter = std::sqrt(left / degrees);
  return spread > kSmallestSpread &&
         spread > kTimesScatter * scatter / std::sqrt(count / static_cast<double>(by_alpha.size()));
}

std::string fit_id(const std::string& id, const std::string& source_model, const std::string& target_model) {
  const std::string chosen = id.empty() ? converter_id(source_model, target_model) : id;
  if (!is_valid_id(chosen))
    throw usage_error("--id: '" + plain(chosen, 60) + "' is not valid (use " + kIdRule + ")");
  return chosen;
}

}  // namespace remap
