// Chebyshev series against functions that they can and cannot hold.
#include "fit/parametric/series.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "lower/evaluate.hpp"
#include "lower/interpreter.hpp"
#include "remap/error.hpp"

using namespace remap;

namespace {

const Domain kDomain{{0.01, 1.0}, {0.0, 1.0}};

template <typename Function>
std::vector<TableRow> rows_of(const Function& function, int widths = 20, int speculars = 12) {
  std::vector<TableRow> rows;
  for (int i = 0; i < widths; ++i)
    for (int j = 1; j <= speculars; ++j) {
      const double alpha = 0.01 + 0.99 * i / (widths - 1), specular = static_cast<double>(j) / speculars;
      const MappedTexel target = function(alpha, specular);
      rows.push_back({alpha, specular, target.alpha, target.specular, 0.0, RowStatus::kOk, rows.size() + 2});
    }
  return rows;
}

MappedTexel cubic(double a, double s) { return {a * (1.0 - 0.3 * a * a), s * (0.9 - 0.2 * a * s)}; }
MappedTexel smooth(double a, double s) { return {a / (0.4 + a), s * std::exp(-a) / (1.0 + 0.3 * a * s)}; }

}  // namespace

TEST_CASE("series: a polynomial is found, with no more terms than it needs") {
  const Regression regression = fit_series_kind(rows_of(cubic), kDomain, 1);
  const auto& series = std::get<Series>(regression.mapping);
  CHECK(series.alpha.coefficients.size() == 1);
  CHECK(series.alpha.coefficients.front().size() == 4);
  for (const double alpha : {0.01, 0.33, 0.9})
    for (const double specular : {0.05, 0.5, 0.97}) {
      const MappedTexel found = evaluate_mapping(regression.mapping, alpha, specular);
      CHECK(found.alpha == Approx(cubic(alpha, specular).alpha).epsilon(1e-6));
      CHECK(found.specular == Approx(cubic(alpha, specular).specular).epsilon(1e-5));
    }
}

TEST_CASE("series: a smooth function is followed to a thousandth of its value, dark ones too") {
  const MappingKind mapping = fit_series_kind(rows_of(smooth), kDomain, 1).mapping;
  for (int i = 0; i <= 50; ++i)
    for (const double specular : {0.085, 0.2, 0.6, 0.99}) {
      const double alpha = 0.01 + 0.99 * i / 50;
      CHECK(evaluate_mapping(mapping, alpha, specular).alpha ==
            Approx(smooth(alpha, specular).alpha).epsilon(1e-3));
      CHECK(evaluate_mapping(mapping, alpha, specular).specular ==
            Approx(smooth(alpha, specular).specular).epsilon(1e-3));
    }
}

TEST_CASE("series: fitted again it keeps its shape and follows other rows") {
  const Regression regression = fit_series_kind(rows_of(cubic), kDomain, 1);
  const Series first = std::get<Series>(regression.mapping),
               again = std::get<Series>(regression.again(rows_of(smooth)));
  CHECK(again.alpha.coefficients.front().size() == first.alpha.coefficients.front().size());
  CHECK(again.specular.coefficients.size() == first.specular.coefficients.size());
  CHECK(again.alpha.coefficients != first.alpha.coefficients);
}

TEST_CASE("series: where the box has no rows, values stay of the size of the others") {
  std::vector<TableRow> rows = rows_of(smooth);
  std::erase_if(rows, [](const TableRow& row) { return row.alpha1 > 0.5 && row.specular1 > 0.5; });
  const MappingKind mapping = fit_series_kind(rows, kDomain, 1).mapping;
  CHECK(std::fabs(evaluate_mapping(mapping, 1.0, 1.0).alpha) < 2.0);
  CHECK(std::fabs(evaluate_mapping(mapping, 1.0, 1.0).specular) < 2.0);
}

TEST_CASE("series: shapes rise in their number of coefficients, and few rows leave few") {
  const std::vector<SeriesShape> shapes = series_shapes({1, kAnyDegree});
  for (std::size_t i = 1; i < shapes.size(); ++i) CHECK(shapes[i].count() >= shapes[i - 1].count());
  CHECK(SeriesShape{3, 3}.count() == 10);
  CHECK(SeriesShape{3, 1}.count() == 7);
  const auto few = std::get<Series>(fit_series_kind(rows_of(smooth, 5, 3), kDomain, 1).mapping);
  CHECK(few.specular.coefficients.front().size() <= 5);
  std::vector<TableRow> one_width = rows_of(smooth);
  for (TableRow& row : one_width) row.alpha1 = 0.3;
  CHECK_THROWS_AS(fit_series_kind(one_width, kDomain, 1), Error);
}
