// Folds of rows, and figures of errors.
#include <array>
#include <cmath>

#include <catch2/catch.hpp>

#include "fit/rows/folds.hpp"
#include "fit/rows/split.hpp"

using namespace remapc;

TEST_CASE("folds: equal rows share a fold, folds are even, draws depend on the seed only") {
  std::vector<TableRow> once;
  for (int i = 0; i < 10; ++i)
    for (int j = 1; j <= 5; ++j)
      once.push_back({0.1 + 0.09 * i, 0.18 * j, 0.1 * i, 0.1 * j, 0.0, RowStatus::kOk, 0});
  std::vector<TableRow> rows = once;
  rows.insert(rows.end(), once.begin(), once.end());
  const auto folds = draw_folds(rows, 5, 7);
  std::array<int, 5> sizes{};
  for (std::size_t i = 0; i < once.size(); ++i) {
    CHECK(folds[i] == folds[i + once.size()]);
    ++sizes[folds[i]];
  }
  for (const int size : sizes) CHECK(size == 10);
  CHECK(folds == draw_folds(rows, 5, 7));
  CHECK(folds != draw_folds(rows, 5, 8));
  CHECK(draw_rows(rows, 30, 1).size() == 30);
}

TEST_CASE("error figures: root mean square, nearest-rank percentile, largest") {
  std::vector<double> errors(200, 0.0);
  errors[0] = -2.0;
  errors[1] = 1.0;
  errors[2] = 0.5;
  const remap::ErrorFigures figures = error_figures(errors);
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
