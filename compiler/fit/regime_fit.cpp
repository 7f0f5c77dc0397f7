#include "fit/regime_fit.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include <Eigen/Dense>

#include "fit/rows/folds.hpp"
#include "model/evaluate.hpp"
#include "model/interpreter.hpp"

namespace remapc {
namespace {

constexpr std::size_t kFewestRows = 20, kFewestWidths = 2;
// Widths beyond the joint to which the mapping is continued. One would do; the second keeps a curve from turning
// back.
constexpr std::size_t kContinuedWidths = 2;
constexpr int kContinuedSpeculars = 5;  // rows of a column
constexpr int kSpeculars = 33;  // at which a joint is looked for
constexpr int kHalvings = 40;
// Pictures are affine in specular, nearly so after the match.
constexpr int kWideSpeculars = 2;
// Times the limit of alpha: where the mapping is held, more than its lowering may change beyond the seam.
constexpr double kBeyondLimit = 1.0 + remap::kSeam + 1e-4;
constexpr double kSameSpecular = 1e-9;
constexpr double kSameJoint = 2e-3;  // between the rows on both sides of a joint, relative to the range of specular

using Column = std::vector<TableRow>;  // rows of one width, by rising specular

std::map<double, Column> columns_of(const std::vector<TableRow>& rows) {
  std::map<double, Column> columns;
  for (const TableRow& row : rows) columns[row.alpha1].push_back(row);
  for (auto& [alpha, column] : columns) std::ranges::sort(column, {}, &TableRow::specular1);
  return columns;
}

bool can_be_fitted(const std::vector<TableRow>& rows) {
  return rows.size() >= kFewestRows && columns_of(rows).size() >= kFewestWidths;
}

// The rows of one regime in `column`, continued to its end: specular in proportion, as pictures are.
void continue_in_specular(const Column& column, RowRegime regime, const TargetLimits& limits,
                          std::vector<TableRow>* rows) {
  const auto is_own = [&](const TableRow& row) { return regime_of(row, limits) == regime; };
  std::vector<TableRow> own;
  std::ranges::copy_if(column, std::back_inserter(own), is_own);
  if (own.size() < 2) return;
  const TableRow &last = own.back(), &before = own[own.size() - 2];
  const double run = last.specular1 - before.specular1;
  if (!(run > 0.0)) return;
  const double slope = (last.specular2 - before.specular2) / run;
  // Few rows, so that they do not outweigh those that were measured.
  const double room = column.back().specular1 - last.specular1;
  for (int i = 1; i <= kContinuedSpeculars && room > 0.0; ++i) {
    TableRow row = last;
    row.specular1 = last.specular1 + room * i / kContinuedSpeculars;
    row.specular2 = last.specular2 + slope * (row.specular1 - last.specular1);
    rows->push_back(row);
  }
}

constexpr std::size_t kExtrapolated = 4;  // rows that a continuation in width passes through

// The value at `x` of the polynomial through the points.
double through(const std::array<double, kExtrapolated>& at, const std::array<double, kExtrapolated>& values,
               double x) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kExtrapolated; ++i) {
    double term = values[i];
    for (std::size_t j = 0; j < kExtrapolated; ++j)
      if (j != i) term *= (x - at[j]) / (at[i] - at[j]);
    sum += term;
  }
  return sum;
}

// The columns inside, continued to the first wide ones by polynomials through their last rows of a specular;
// `keeps_specular`: in width alone.
void continue_in_alpha(const std::map<double, Column>& inside, const std::map<double, Column>& wide,
                       bool keeps_specular, std::vector<TableRow>* rows) {
  std::size_t done = 0;
  for (const auto& [alpha, column] : wide) {
    if (done == kContinuedWidths) break;
    ++done;
    for (TableRow row : column) {
      std::vector<const TableRow*> neighbours;
      for (auto other = inside.rbegin(); other != inside.rend() && neighbours.size() < kExtrapolated; ++other)
        for (const TableRow& candidate : other->second)
          if (other->first < alpha && std::fabs(candidate.specular1 - row.specular1) < kSameSpecular)
            neighbours.push_back(&candidate);
      if (neighbours.size() < kExtrapolated) continue;
      std::array<double, kExtrapolated> at{}, alphas{}, speculars{};
      for (std::size_t i = 0; i < kExtrapolated; ++i) {
        at[i] = neighbours[i]->alpha1;
        alphas[i] = neighbours[i]->alpha2;
        speculars[i] = neighbours[i]->specular2;
      }
      row.alpha2 = through(at, alphas, alpha);
      if (!keeps_specular) row.specular2 = through(at, speculars, alpha);
      rows->push_back(row);
    }
  }
}

// The rows of corners that end where the bright regime begins: alpha is at its limit there, and not yet beyond.
void add_bright_ends(const Column& column, const TargetLimits& limits, std::vector<TableRow>* rows) {
  for (std::size_t i = 0; i + 1 < column.size(); ++i)
    if (regime_of(column[i], limits) == RowRegime::kCorner &&
        regime_of(column[i + 1], limits) == RowRegime::kBright &&
        column[i + 1].specular1 - column[i].specular1 < kSameJoint * column.back().specular1)
      rows->push_back(column[i]);
}

// Where a rising function passes `value`; none if it does not in the range.
template <typename Function>
std::optional<double> passed_at(const Function& rising, const remap::Range& range, double value) {
  double low = range.min, high = range.max;
  if (!(rising(low) <= value) || !(rising(high) >= value)) return std::nullopt;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (rising(middle) < value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// The shape of a series: the sum of the degrees of its terms is at most `degree`, that in specular at most
// `of_specular`.
struct SeriesShape {
  int degree, of_specular;
  std::size_t count() const {
    std::size_t terms = 0;
    for (int j = 0; j <= std::min(degree, of_specular); ++j) terms += static_cast<std::size_t>(degree - j + 1);
    return terms;
  }
};

// Weight of the squares of coefficients, relative to one row: nothing where there are rows, but it keeps the series
// from growing in the part of its box where there are none.
constexpr double kRidge = 1e-4;

// Errors count relative to the value, as pictures show them; below this share of a limit as those of the share.
constexpr double kLeastValue = 0.02;
double weight_of(double value) { return 1.0 / std::max(value, kLeastValue); }

// T_0 to T_degree of `value` in its range.
Eigen::VectorXd chebyshev_row(const remap::Range& range, double value, int degree) {
  const double x = 2.0 * (value - range.min) / (range.max - range.min) - 1.0;
  Eigen::VectorXd row(degree + 1);
  row(0) = 1.0;
  if (degree > 0) row(1) = x;
  for (int i = 2; i <= degree; ++i) row(i) = 2.0 * x * row(i - 1) - row(i - 2);
  return row;
}

// The series of least squares over the box of `series`.
remap::TexelSeries fitted_series(const std::vector<TableRow>& rows, double TableRow::*output,
                                 remap::TexelSeries series, const SeriesShape& shape) {
  const auto count = static_cast<Eigen::Index>(rows.size()), terms = static_cast<Eigen::Index>(shape.count());
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(count + terms, terms);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(count + terms);
  const int powers = std::min(shape.degree, shape.of_specular);
  for (Eigen::Index r = 0; r < count; ++r) {
    const TableRow& row = rows[static_cast<std::size_t>(r)];
    const Eigen::VectorXd of_alpha = chebyshev_row(series.alpha, row.alpha1, shape.degree);
    const Eigen::VectorXd of_specular = chebyshev_row(series.specular, row.specular1, powers);
    const double weight = weight_of(row.*output);
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

constexpr std::size_t kSeriesFolds = 5;
constexpr double kRowsATerm = 1.5;  // at least
constexpr std::array kDegrees = {1, 2, 3, 4, 6, 8, 10, 12};

// The simplest series that counts as equal to the best in cross-validation (folds.hpp). `widths`: the number of
// different alpha1, which a degree stays below.
remap::TexelSeries best_series(const std::vector<TableRow>& rows, std::size_t widths, double TableRow::*output,
                               const remap::TexelSeries& box, int of_specular, std::uint64_t seed) {
  const std::vector<Fold> folds = split_folds(rows, kSeriesFolds, seed);
  std::vector<SeriesShape> shapes;
  std::vector<CrossValidated> scores;
  for (const int degree : kDegrees) {
    const SeriesShape shape{degree, of_specular};
    const bool is_determined = static_cast<std::size_t>(degree) + 1 <= widths &&
                               kRowsATerm * static_cast<double>(shape.count()) <= static_cast<double>(rows.size());
    if (degree > 1 && !is_determined) break;
    std::vector<std::vector<double>> errors;
    for (const Fold& fold : folds) {
      const remap::TexelSeries series = fitted_series(fold.training, output, box, shape);
      errors.emplace_back();
      for (const TableRow& row : fold.judging)
        errors.back().push_back((remap::series_value(series, row.alpha1, row.specular1) - row.*output) *
                                weight_of(row.*output));
    }
    shapes.push_back(shape);
    scores.push_back(cross_validated(errors));
  }
  const double bound = error_bound(scores);
  const auto chosen =
      std::ranges::find_if(scores, [&](const CrossValidated& score) { return score.rms <= bound; });
  return fitted_series(rows, output, box, shapes[static_cast<std::size_t>(chosen - scores.begin())]);
}

std::string series_text(const remap::TexelSeries& series, std::size_t rows) {
  return "degree " + std::to_string(series.coefficients.front().size() - 1) + ", up to " +
         std::to_string(series.coefficients.size() - 1) + " in specular, " + std::to_string(rows) + " rows";
}

class RegimeFit {
 public:
  RegimeFit(const RegimeRows& rows, const TargetLimits& limits, const remap::MappingKind& mapping,
            const remap::Domain& domain, std::uint64_t seed, std::map<std::string, std::string>* method)
      : rows_(rows), limits_(limits), mapping_(mapping), domain_(domain), seed_(seed), method_(method) {}

  remap::Regimes fit() {
    remap::Regimes regimes;
    regimes.alpha_limit = limits_.alpha;
    regimes.specular_limit = limits_.specular;
    if (!rows_.wide.empty()) regimes.wide = fit_wide();
    if (!rows_.bright.empty()) {
      const double to = regimes.wide ? regimes.wide->specular.alpha.min : domain_.alpha.max;
      regimes.bright = fit_bright(to);
    }
    return regimes;
  }

 private:
  remap::MappedTexel mapped(double alpha, double specular) const {
    return remap::evaluate_mapping(mapping_, alpha, specular);
  }

  // The width of the source at which the mapping gives `alpha`, between the columns inside and the end of the rows to
  // which it was continued.
  std::optional<double> joint(double specular, double alpha) const {
    const auto [low, high] = std::ranges::minmax_element(rows_.inside, {}, &TableRow::alpha1);
    return passed_at([&](double source) { return mapped(source, specular).alpha; },
                     {low->alpha1, high->alpha1}, alpha);
  }

  std::optional<remap::WideRegime> fit_wide() {
    remap::WideRegime wide{domain_.alpha.min, {domain_.alpha, domain_.specular, {}}};
    wide.specular.alpha.min = domain_.alpha.max;
    for (int i = 0; i < kSpeculars; ++i) {
      const double specular = domain_.specular.max * i / (kSpeculars - 1);
      const auto from = joint(specular, limits_.alpha), to = joint(specular, limits_.alpha * kBeyondLimit);
      if (!from || !to) return std::nullopt;
      wide.specular.alpha.min = std::min(wide.specular.alpha.min, *from);
      wide.mapping_to = std::max(wide.mapping_to, *to);
    }
    std::vector<TableRow> rows = rows_.wide;
    std::set<double> speculars;
    for (const TableRow& row : rows_.wide) speculars.insert(row.specular1);
    for (const double specular : speculars) {
      TableRow row;
      row.alpha1 = *joint(specular, limits_.alpha);
      row.specular1 = specular;
      row.specular2 = mapped(row.alpha1, specular).specular;
      rows.push_back(row);
    }
    wide.specular = best_series(rows, columns_of(rows_.wide).size() + 1, &TableRow::specular2, wide.specular, kWideSpeculars, seed_);
    (*method_)["wide"] = series_text(wide.specular, rows.size());
    return wide;
  }

  // `mapping_to`: the largest width at which the mapping is joined.
  remap::TexelSeries fit_bright(double mapping_to) {
    std::vector<TableRow> rows = rows_.bright;
    for (const auto& [alpha, column] : columns_of(rows_.bright)) {
      if (alpha > mapping_to) break;
      const auto rising = [&, width = alpha](double specular) { return mapped(width, specular).specular; };
      const auto specular = passed_at(rising, {0.0, domain_.specular.max}, *limits_.specular);
      if (!specular) continue;
      TableRow row;
      row.alpha1 = alpha;
      row.specular1 = *specular;
      row.alpha2 = mapped(alpha, *specular).alpha;
      if (row.alpha2 < limits_.alpha) rows.push_back(row);
    }
    const auto least = [&](double TableRow::*input) { return (*std::ranges::min_element(rows, {}, input)).*input; };
    const remap::TexelSeries box{{width_before(least(&TableRow::alpha1)), domain_.alpha.max},
                                 {least(&TableRow::specular1), domain_.specular.max},
                                 {}};
    const remap::TexelSeries series = best_series(rows, columns_of(rows).size(), &TableRow::alpha2, box, kDegrees.back(), seed_);
    (*method_)["bright"] = series_text(series, rows.size());
    return series;
  }

  // The width of the table before `alpha`: between the two, the first bright texels lie.
  double width_before(double alpha) const {
    double before = domain_.alpha.min;
    for (const TableRow& row : rows_.inside)
      if (row.alpha1 < alpha) before = std::max(before, row.alpha1);
    return before;
  }

  const RegimeRows& rows_;
  const TargetLimits& limits_;
  const remap::MappingKind& mapping_;
  const remap::Domain& domain_;
  std::uint64_t seed_;
  std::map<std::string, std::string>* method_;
};

}  // namespace

RegimeRows regime_rows(const std::vector<TableRow>& training, const std::vector<TableRow>& all,
                       const TargetLimits& limits) {
  RegimeRows rows;
  for (const TableRow& row : training) switch (regime_of(row, limits)) {
      case RowRegime::kInside:
        rows.inside.push_back(row);
        break;
      case RowRegime::kWide:
        rows.wide.push_back(row);
        break;
      case RowRegime::kBright:
        rows.bright.push_back(row);
        break;
      case RowRegime::kCorner:
      case RowRegime::kNone:
        break;
    }
  if (!can_be_fitted(rows.bright)) rows.bright.clear();
  std::map<double, Column> inside, wide;
  for (const auto& [alpha, column] : columns_of(all))
    for (const TableRow& row : column) {
      if (regime_of(row, limits) == RowRegime::kInside) inside[alpha].push_back(row);
      if (regime_of(row, limits) == RowRegime::kWide) wide[alpha].push_back(row);
    }
  const bool has_wide = can_be_fitted(rows.wide);
  if (!has_wide) rows.wide.clear();
  for (const auto& [alpha, column] : columns_of(training)) {
    continue_in_specular(column, RowRegime::kInside, limits, &rows.inside);
    if (has_wide) continue_in_specular(column, RowRegime::kWide, limits, &rows.wide);
    if (!rows.bright.empty()) add_bright_ends(column, limits, &rows.bright);
  }
  continue_in_alpha(inside, wide, !has_wide, &rows.inside);
  return rows;
}

remap::Regimes fit_regimes(const RegimeRows& rows, const TargetLimits& limits, const remap::MappingKind& mapping,
                           const remap::Domain& domain, std::uint64_t seed,
                           std::map<std::string, std::string>* method) {
  return RegimeFit(rows, limits, mapping, domain, seed, method).fit();
}

}  // namespace remapc
