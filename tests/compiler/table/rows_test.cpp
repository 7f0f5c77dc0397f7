// This file tests how rows are drawn, and the figures of errors.
#include <array>
#include <cmath>

#include <catch2/catch.hpp>

#include "table/regression.hpp"

using namespace remap;

TEST_CASE("rows: draws keep their order and depend on the seed only") {
  std::vector<TableRow> rows;
  for (int i = 0; i < 100; ++i) rows.push_back({0.01 * i, 0.5, 0.01 * i, 0.4, 0.0, RowStatus::kOk, 0});
  const std::vector<TableRow> drawn = draw_rows(rows, 30, 1);
  REQUIRE(drawn.size() == 30);
  for (std::size_t i = 1; i < drawn.size(); ++i) CHECK(drawn[i].alpha1 > drawn[i - 1].alpha1);
  CHECK(draw_rows(rows, 30, 1)[7].alpha1 == drawn[7].alpha1);
}

TEST_CASE("error figures: root mean square, nearest-rank percentile, largest") {
  std::vector<double> errors(200, 0.0);
  errors[0] = -2.0;
  errors[1] = 1.0;
  errors[2] = 0.5;
  const ErrorFigures figures = error_figures(errors);
  CHECK(figures.max == 2.0);
  CHECK(figures.p99 == 0.5);
  CHECK(figures.rms == Approx(std::sqrt(5.25 / 200)));
}

TEST_CASE("error text: two digits, rounded up, in one style for large and small") {
  CHECK(error_text(0.0) == "0");
  CHECK(error_text(0.00072) == "7.2e-04");
  CHECK(error_text(0.0002) == "2.0e-04");
  CHECK(error_text(1.2301e-7) == "1.3e-07");
  CHECK(error_text(0.996) == "1.0e+00");
  CHECK(error_text(2.0) == "2.0e+00");
}
