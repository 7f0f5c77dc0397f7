// Fits of tables that reach the limits of their target, against the conversion in closed form.
#include "fit/regime_fit.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <catch2/catch.hpp>

#include "fit/fit_table.hpp"
#include "lower/interpreter.hpp"
#include "lower/lower.hpp"
#include "remap/error.hpp"
#include "support/made_regimes.hpp"

using namespace remap;
using made_regimes::Place;

namespace {

// A grid and, as a sweep adds them, rows on both sides of where regimes meet.
Table regime_table(int widths = 30, int speculars = 30) {
  Table table;
  table.name = "made.csv";
  table.source = {"mitsuba/ward", RoughnessConvention::kAlpha, "specular"};
  table.target = {"mitsuba/as", RoughnessConvention::kAlpha, "f0"};
  table.comments = {{kAlphaLimitComment, "0.9"}, {kSpecularLimitComment, "1"}};
  const auto add = [&](double alpha, double specular) {
    const MappedTexel target = made_regimes::exact(alpha, specular);
    const bool is_ok = made_regimes::place(alpha, specular) == Place::kInside;
    table.rows.push_back({alpha, specular, target.alpha, target.specular, 0.1,
                          is_ok ? RowStatus::kOk : RowStatus::kClamped, table.rows.size() + 2});
  };
  for (int i = 0; i < widths; ++i) {
    const double alpha = 0.01 + 0.99 * i / (widths - 1);
    std::set<double> column;
    for (int j = 1; j <= speculars; ++j) column.insert(static_cast<double>(j) / speculars);
    const std::vector<double> grid(column.begin(), column.end());
    for (std::size_t j = 0; j + 1 < grid.size(); ++j) {
      double low = grid[j], high = grid[j + 1];
      const Place first = made_regimes::place(alpha, low);
      if (made_regimes::place(alpha, high) == first) continue;
      for (int halving = 0; halving < 12; ++halving) {
        const double middle = 0.5 * (low + high);
        (made_regimes::place(alpha, middle) == first ? low : high) = middle;
      }
      column.insert({low, high});
    }
    for (const double specular : column) add(alpha, specular);
  }
  find_limits(&table);
  return table;
}

Fit fit_of(const Table& table, std::string_view kind) {
  FitOptions options;
  options.kind = kind;
  options.regression.form = kind == "parametric" ? "paper" : "";
  return fit_table(table, table_text(table), options).fit;
}

// The largest differences from the closed form over materials that are in no row.
MappedTexel worst_of(const Fit& fit) {
  MappedTexel worst;
  for (int i = 0; i <= 173; ++i)
    for (int j = 0; j <= 171; ++j) {
      const double alpha = 0.01 + 0.99 * i / 173, specular = 0.03 + 0.97 * j / 171;
      const MappedTexel found = evaluate_fit(fit, alpha, specular),
                        exact = made_regimes::exact(alpha, specular);
      worst.alpha = std::max(worst.alpha, std::fabs(found.alpha - exact.alpha));
      worst.specular = std::max(worst.specular, std::fabs(found.specular - exact.specular));
    }
  return worst;
}

}  // namespace

TEST_CASE("regime fit: every regime follows the closed form between the rows") {
  for (const std::string_view kind : {"series", "parametric"}) {
    const Fit fit = fit_of(regime_table(), kind);
    CHECK(fit.domain == Domain{{0.01, 1.0}, {0.0, 1.0}});
    CHECK(fit.regimes.alpha_limit == 0.9);
    CHECK(fit.regimes.specular_limit == 1.0);
    REQUIRE(fit.regimes.wide.has_value());
    REQUIRE(fit.regimes.bright.has_value());
    CHECK(fit.regimes.wide->mapping_to == Approx(made_regimes::kWideFrom).epsilon(0.01));
    const MappedTexel worst = worst_of(fit);
    CHECK(worst.alpha < 4e-3);  // the seam, half a hundredth of the limit
    CHECK(worst.specular < 4e-3);
    CHECK(fit.alpha_error.max < 4e-3);
    CHECK(lower(fit).has_limits());
  }
}

TEST_CASE("regime fit: the same seed gives the same fit") {
  const Table table = regime_table(12, 8);
  CHECK(fit_of(table, "series") == fit_of(table, "series"));
}

TEST_CASE("regime fit: without limits in its comments, a table ends where its target does") {
  Table table = regime_table();
  table.limits = {};
  for (TableRow& row : table.rows)
    if (row.status != RowStatus::kOk) row.status = RowStatus::kClamped;
  const Fit fit = fit_of(table, "series");
  CHECK(fit.regimes == Regimes{});
  CHECK(fit.domain.alpha.max < made_regimes::kWideFrom);
}

TEST_CASE("regime fit: too few rows of a regime leave the mapping cut off at the limit") {
  Table table = regime_table();
  std::erase_if(table.rows, [](const TableRow& row) {
    return row.alpha1 > 0.62 || (row.alpha1 > made_regimes::kWideFrom && row.specular1 > 0.2);
  });
  const Fit fit = fit_of(table, "series");
  CHECK_FALSE(fit.regimes.wide.has_value());
  CHECK(fit.domain.alpha.max == Approx(0.62).margin(0.04));
  const MappedTexel end = evaluate_fit(fit, fit.domain.alpha.max, 0.3);
  CHECK(end.alpha <= 0.9);
  CHECK(end.specular == Approx(made_regimes::free_specular(fit.domain.alpha.max, 0.3)).margin(0.01));
}

// `steepness` decides at which width the limit of alpha, 1, is reached; there, specular falls faster.
TEST_CASE("regime fit: a width that is partly at the limit, and a single width beyond it") {
  for (const double steepness : {1.4, 1.347}) {
    INFO(steepness);
    const auto exact = [&](double alpha, double specular) {
      const double free = steepness * (alpha - 0.25 * alpha * alpha) * (0.97 + 0.03 * specular);
      return MappedTexel{std::min(free, 1.0), 0.7 * specular * (1.0 - 2.0 * std::max(0.0, free - 1.0))};
    };
    Table table = regime_table(1, 1);
    table.rows.clear();
    table.comments = {{kAlphaLimitComment, "1"}, {kSpecularLimitComment, "1"}};
    for (int i = 0; i < 30; ++i)
      for (int j = 1; j <= 30; ++j) {
        const double alpha = 0.01 + 0.99 * i / 29, specular = j / 30.0;
        const MappedTexel target = exact(alpha, specular);
        table.rows.push_back({alpha, specular, target.alpha, target.specular, 0.0,
                              target.alpha < 1.0 ? RowStatus::kOk : RowStatus::kClamped,
                              table.rows.size() + 2});
      }
    find_limits(&table);
    const Fit fit = fit_of(table, "series");
    REQUIRE(fit.regimes.wide.has_value());
    for (int i = 0; i <= 97; ++i)
      for (int j = 1; j <= 53; ++j) {
        const double alpha = 0.01 + 0.99 * i / 97, specular = j / 53.0;
        const MappedTexel found = evaluate_fit(fit, alpha, specular), right = exact(alpha, specular);
        REQUIRE(found.alpha == Approx(right.alpha).margin(2e-3));
        REQUIRE(found.specular == Approx(right.specular).margin(2e-3));
      }
  }
}

TEST_CASE("regime fit: a model that reaches its limits at the last rows alone has no regimes of its own") {
  Table table = regime_table(1, 1);
  table.rows.clear();
  table.comments = {{kAlphaLimitComment, "1"}, {kSpecularLimitComment, "1"}};
  for (int i = 0; i < 30; ++i)
    for (int j = 1; j <= 30; ++j) {
      const double alpha = 0.01 + 0.99 * i / 29, specular = j / 30.0;
      const RowStatus status = alpha == 1.0 || specular == 1.0 ? RowStatus::kClamped : RowStatus::kOk;
      table.rows.push_back({alpha, specular, alpha, specular, 0.0, status, table.rows.size() + 2});
    }
  find_limits(&table);
  const Fit fit = fit_of(table, "series");
  CHECK_FALSE(fit.regimes.wide.has_value());
  CHECK_FALSE(fit.regimes.bright.has_value());
  CHECK(fit.domain == Domain{{0.01, 1.0}, {0.0, 1.0}});
  for (const double value : {0.013, 0.3, 0.99, 1.0}) {
    CHECK(evaluate_fit(fit, value, 1.0).alpha == Approx(value).margin(1e-5));
    CHECK(evaluate_fit(fit, 1.0, value).specular == Approx(value).margin(1e-5));
  }
}
