#include "table/row_regime.hpp"

#include <algorithm>
#include <iterator>

#include "text/errors.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

constexpr double kSameLimit = 1e-8;  // relative: tables hold ten digits

std::optional<double> limit_in(const Table& table, const std::string& key) {
  for (const auto& [found, value] : table.comments) {
    if (found != key) continue;
    const auto limit = remap::parse_number(value);
    if (!limit || !(*limit > 0.0))
      throw input_error(table.name + ": the comment " + key + " is \"" + value +
                        "\" (must be a number above 0)");
    return limit;
  }
  return std::nullopt;
}

}  // namespace

TargetLimits target_limits(const Table& table) {
  const std::optional<double> alpha = limit_in(table, kAlphaLimitComment);
  return {alpha.value_or(1.0), limit_in(table, kSpecularLimitComment), alpha.has_value()};
}

RowRegime regime_of(const TableRow& row, const TargetLimits& limits) {
  if (row.status == RowStatus::kOk) return RowRegime::kInside;
  if (row.status != RowStatus::kClamped || !limits.are_known) return RowRegime::kNone;
  const bool is_wide = row.alpha2 >= limits.alpha * (1.0 - kSameLimit);
  const bool is_bright = limits.specular && row.specular2 >= *limits.specular * (1.0 - kSameLimit);
  if (is_wide) return is_bright ? RowRegime::kCorner : RowRegime::kWide;
  return is_bright ? RowRegime::kBright : RowRegime::kNone;
}

std::vector<TableRow> answer_rows(const Table& table) {
  const TargetLimits limits = target_limits(table);
  std::vector<TableRow> rows;
  std::ranges::copy_if(table.rows, std::back_inserter(rows),
                       [&](const TableRow& row) { return regime_of(row, limits) != RowRegime::kNone; });
  return rows;
}

}  // namespace remapc
