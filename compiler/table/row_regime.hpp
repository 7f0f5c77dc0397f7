// Which regime of a fit (remap/regimes.hpp) a row belongs to.
#pragma once

#include <optional>
#include <vector>

#include "table/table.hpp"

namespace remapc {

// The comments in which a sweep records the largest alpha and canonical specular that its target takes.
inline constexpr const char* kAlphaLimitComment = "target_alpha_limit";
inline constexpr const char* kSpecularLimitComment = "target_specular_limit";

struct TargetLimits {
  double alpha = 1.0;              // 1 where a table does not tell
  std::optional<double> specular;  // none where a table does not tell
  bool are_known = false;          // whether the table tells
};

// Throws kInput for a comment that is not a number above 0.
TargetLimits target_limits(const Table& table);

enum class RowRegime {
  kInside,
  kWide,    // alpha2 is at its limit
  kBright,  // specular2 is at its limit
  kCorner,  // both are
  kNone,    // no answer: flat, unstable, or clamped at another bound
};
RowRegime regime_of(const TableRow& row, const TargetLimits& limits);

// The rows that belong to a regime.
std::vector<TableRow> answer_rows(const Table& table);

}  // namespace remapc
