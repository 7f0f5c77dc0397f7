// Which regime a row of a sweep belongs to.
#include "table/row_regime.hpp"

#include <catch2/catch.hpp>

using namespace remapc;

namespace {

TableRow row(double alpha2, double specular2, RowStatus status) {
  return {0.5, 0.5, alpha2, specular2, 0.1, status, 2};
}

}  // namespace

TEST_CASE("row regime: a clamped row belongs to the limits that it is at") {
  const TargetLimits limits{0.9, 1.0, true};
  CHECK(regime_of(row(0.3, 0.3, RowStatus::kOk), limits) == RowRegime::kInside);
  CHECK(regime_of(row(0.9, 0.3, RowStatus::kClamped), limits) == RowRegime::kWide);
  CHECK(regime_of(row(0.3, 1.0, RowStatus::kClamped), limits) == RowRegime::kBright);
  CHECK(regime_of(row(0.9, 1.0, RowStatus::kClamped), limits) == RowRegime::kCorner);
  CHECK(regime_of(row(0.3, 0.0, RowStatus::kClamped), limits) == RowRegime::kNone);  // at a lower bound
  CHECK(regime_of(row(0.9, 0.3, RowStatus::kFlat), limits) == RowRegime::kNone);
  CHECK(regime_of(row(0.9, 0.3, RowStatus::kUnstable), limits) == RowRegime::kNone);
}

TEST_CASE("row regime: a table that does not tell its limits has answers inside alone") {
  Table table;
  table.name = "t.csv";
  CHECK_FALSE(target_limits(table).are_known);
  CHECK(regime_of(row(1.0, 1.0, RowStatus::kClamped), target_limits(table)) == RowRegime::kNone);
  table.comments = {{kAlphaLimitComment, "0.9"}};
  CHECK(target_limits(table).alpha == 0.9);
  CHECK_FALSE(target_limits(table).specular.has_value());
  CHECK(regime_of(row(0.9, 1.0, RowStatus::kClamped), target_limits(table)) == RowRegime::kWide);
  table.comments = {{kAlphaLimitComment, "-1"}};
  CHECK_THROWS_WITH(target_limits(table), Catch::Contains("t.csv") && Catch::Contains("a number above 0"));
}
