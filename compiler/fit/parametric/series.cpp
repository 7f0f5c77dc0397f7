#include "fit/parametric/series.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <Eigen/Dense>

#include "lower/evaluate.hpp"
#include "remap/error.hpp"
#include "table/choice.hpp"

namespace remap {
namespace {

constexpr std::array kDegrees = {1, 2, 3, 4, 6, 8, 10, 12, 16};
constexpr std::size_t kSeriesFolds = 5;
constexpr double kEnough = 1e-3;    // a quarter of an 8-bit step (decision 048)
constexpr double kRowsATerm = 1.5;  // at least

// Weight of the squares of coefficients, relative to one row.
constexpr double kRidge = 1e-4;

// T_0 to T_degree of `value` in its range.
Eigen::VectorXd chebyshev_row(const Range& range, double value, int degree) {
  const double x = 2.0 * (value - range.min) / (range.max - range.min) - 1.0;
  Eigen::VectorXd row(degree + 1);
  row(0) = 1.0;
  if (degree > 0) row(1) = x;
  for (int i = 2; i <= degree; ++i) row(i) = 2.0 * x * row(i - 1) - row(i - 2);
  return row;
}

SeriesShape shape_of(const TexelSeries& series) {
  return {static_cast<int>(series.coefficients.front().size()) - 1,
          static_cast<int>(series.coefficients.size()) - 1};
}

bool is_determined(const SeriesShape& shape, std::size_t rows, std::size_t widths) {
  return static_cast<std::size_t>(shape.degree) + 1 <= widths &&
         kRowsATerm * static_cast<double>(shape.count()) <= static_cast<double>(rows);
}

// Of target alpha, root mean square.
double relative_error(const std::vector<TableRow>& rows, const TexelSeries& alpha) {
  double sum = 0.0;
  for (const TableRow& row : rows) {
    const double error =
        error_weight(row.alpha2) * (series_value(alpha, row.alpha1, row.specular1) - row.alpha2);
    sum += error * error;
  }
  return std::sqrt(sum / static_cast<double>(rows.size()));
}

// A fit of one output, which leaves the other one at 0.
Series series_of(double TableRow::*output, const TexelSeries& series) {
  const TexelSeries none{{0.0, 1.0}, {0.0, 1.0}, {{0.0}}};
  return output == &TableRow::alpha2 ? Series{series, none} : Series{none, series};
}

}  // namespace

std::size_t SeriesShape::count() const {
  std::size_t terms = 0;
  for (int j = 0; j <= std::min(degree, of_specular); ++j) terms += static_cast<std::size_t>(degree - j + 1);
  return terms;
}

std::vector<SeriesShape> series_shapes(const std::vector<int>& of_specular) {
  std::vector<SeriesShape> shapes;
  for (const int degree : kDegrees)
    for (const int power : of_specular) shapes.push_back({degree, std::min(degree, power)});
  std::ranges::stable_sort(shapes, {}, &SeriesShape::count);
  shapes.erase(std::unique(shapes.begin(), shapes.end()),
               shapes.end());  // clang 14 has no std::ranges::unique
  return shapes;
}

TexelSeries fit_series(const std::vector<TableRow>& rows, double TableRow::*output, TexelSeries series,
                       const SeriesShape& shape) {
  const auto count = static_cast<Eigen::Index>(rows.size()), terms = static_cast<Eigen::Index>(shape.count());
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(count + terms, terms);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(count + terms);
  const int powers = std::min(shape.degree, shape.of_specular);
  for (Eigen::Index r = 0; r < count; ++r) {
    const TableRow& row = rows[static_cast<std::size_t>(r)];
    const Eigen::VectorXd of_alpha = chebyshev_row(series.alpha, row.alpha1, shape.degree);
    const Eigen::VectorXd of_specular = chebyshev_row(series.specular, row.specular1, powers);
    const double weight = error_weight(row.*output);
    values(r) = weight * row.*output;
    Eigen::Index term = 0;
    for (int j = 0; j <= powers; ++j)
      for (int i = 0; i <= shape.degree - j; ++i) basis(r, term++) = weight * of_alpha(i) * of_specular(j);
  }
  Eigen::Index term = 0;
  for (int j = 0; j <= powers; ++j)
    for (int i = 0; i <= shape.degree - j; ++i, ++term) basis(count + term, term) = kRidge * (1.0 + i + j);
  const Eigen::VectorXd found = basis.householderQr().solve(values);
  series.coefficients.clear();
  const double* next = found.data();
  for (int j = 0; j <= powers; ++j, next += shape.degree - j + 2)
    series.coefficients.emplace_back(next, next + shape.degree - j + 1);
  return series;
}

TexelSeries best_series(const std::vector<TableRow>& rows, std::size_t widths, double TableRow::*output,
                        const TexelSeries& box, const std::vector<SeriesShape>& shapes, std::uint64_t seed) {
  std::vector<SeriesShape> tried;
  std::vector<Candidate> candidates;
  for (const SeriesShape& shape : shapes) {
    if (!tried.empty() && !is_determined(shape, rows.size(), widths)) continue;
    tried.push_back(shape);
    candidates.emplace_back().record.number_count = shape.count();
    candidates.back().regression.again = [=, &box](const std::vector<TableRow>& some) {
      return series_of(output, fit_series(some, output, box, shape));
    };
  }
  cross_validate(candidates, split_folds(rows, kSeriesFolds, seed), error_weight, 1);
  const std::size_t chosen = choose(&candidates);
  if (chosen == candidates.size())
    throw Error(ErrorKind::kNumeric, "series: no degree follows the rows (errors are not finite)");
  return fit_series(rows, output, box, tried[chosen]);
}

std::string series_text(const TexelSeries& series) {
  const SeriesShape shape = shape_of(series);
  return "degree " + std::to_string(shape.degree) + ", up to " + std::to_string(shape.of_specular) +
         " in specular";
}

Regression fit_series_kind(const std::vector<TableRow>& rows, const Domain& domain, std::uint64_t seed) {
  require_variety(rows, "series");
  std::set<double> widths;
  for (const TableRow& row : rows) widths.insert(row.alpha1);
  const TexelSeries box{domain.alpha, domain.specular, {}};
  const std::vector<int> any = {1, 2, 4, kAnyDegree};
  const auto best_alpha = [&](const std::vector<int>& of_alpha) {
    return best_series(rows, widths.size(), &TableRow::alpha2, box, series_shapes(of_alpha), seed);
  };
  Series series;
  series.alpha = best_alpha(alpha_needs_specular(rows) ? any : std::vector{0});
  // Alpha may rise and fall with specular, which no straight line shows.
  if (shape_of(series.alpha).of_specular == 0 && relative_error(rows, series.alpha) > kEnough)
    series.alpha = best_alpha(any);
  series.specular =
      best_series(rows, widths.size(), &TableRow::specular2, box, series_shapes({1, 2, 4, kAnyDegree}), seed);
  const auto again = [series](const std::vector<TableRow>& some) {
    return Series{fit_series(some, &TableRow::alpha2, series.alpha, shape_of(series.alpha)),
                  fit_series(some, &TableRow::specular2, series.specular, shape_of(series.specular))};
  };
  return {series, {{"alpha", series_text(series.alpha)}, {"specular", series_text(series.specular)}}, again};
}

}  // namespace remap
