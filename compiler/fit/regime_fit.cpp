#include "fit/regime_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "fit/parametric/series.hpp"
#include "lower/interpreter.hpp"

namespace remap {
namespace {

// The joint of the wide regime is one more width, with a row for each specular. Five rows determine a bright
// series of degree 1.
constexpr std::size_t kFewestWide = 8, kFewestBright = 5, kFewestBrightWidths = 2;
// Widths beyond the joint at every specular to which the mapping is continued. One would do; the second keeps
// a curve from turning back.
constexpr std::size_t kContinuedWidths = 2;
constexpr int kContinuedSpeculars = 5;  // rows of a column
// Share of its own range by which a wide column is continued: its series has degree 2, and must not bend to
// rows that nobody measured.
constexpr double kContinuedWide = 0.25;
constexpr int kSpeculars = 33;  // at which a joint is looked for
constexpr int kHalvings = 40;
// Pictures are affine in specular, nearly so after the match.
constexpr int kWideSpeculars = 2;
// Times the limit of alpha: where the mapping is clamped, more than its lowering may change beyond the seam.
constexpr double kBeyondLimit = 1.0 + kSeam + 1e-4;
// Of a bright series. Its rows leave a part of its box empty, where higher degrees oscillate more than a
// table can follow.
constexpr int kBrightDegree = 12;
constexpr double kLeastWide = 1e-3;    // of source alpha
constexpr double kLeastBright = 1e-3;  // of the range of source specular
constexpr double kSameJoint =
    2e-3;  // between the rows on both sides of a joint, relative to the range of specular

constexpr double kApart = 0.01;  // speculars of different rows of the grid, at least

using Column = std::vector<TableRow>;  // rows of one width, by rising specular

std::map<double, Column> columns_of(const std::vector<TableRow>& rows) {
  std::map<double, Column> columns;
  for (const TableRow& row : rows) columns[row.alpha1].push_back(row);
  for (auto& [alpha, column] : columns) std::ranges::sort(column, {}, &TableRow::specular1);
  return columns;
}

bool has_status(const Column& column, RowStatus status) {
  return std::ranges::count(column, status, &TableRow::status) != 0;
}

// The rows of one regime in `column`, continued to its end: specular in proportion, as pictures are.
void continue_in_specular(const Column& column, RowStatus regime, std::vector<TableRow>* rows) {
  const auto is_own = [&](const TableRow& row) { return row.status == regime; };
  std::vector<TableRow> own;
  std::ranges::copy_if(column, std::back_inserter(own), is_own);
  if (own.size() < 2) return;
  const TableRow &last = own.back(), &before = own[own.size() - 2];
  const double run = last.specular1 - before.specular1;
  if (!(run > 0.0)) return;
  const double slope = (last.specular2 - before.specular2) / run;
  // Few rows, so that they do not outweigh those that were measured.
  double room = column.back().specular1 - last.specular1;
  if (regime == RowStatus::kWide) room = std::min(room, kContinuedWide * last.specular1);
  for (int i = 1; i <= kContinuedSpeculars && room > 0.0; ++i) {
    TableRow row = last;
    row.specular1 = last.specular1 + room * i / kContinuedSpeculars;
    row.specular2 = last.specular2 + slope * (row.specular1 - last.specular1);
    rows->push_back(row);
  }
}

constexpr std::size_t kExtrapolated = 4;  // columns that a continuation in width passes through

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

// The targets of a column at `specular`, by straight lines between its rows; none beyond them.
std::optional<MappedTexel> target_in(const Column& column, double specular) {
  const auto above = std::ranges::lower_bound(column, specular, {}, &TableRow::specular1);
  if (above == column.end()) return std::nullopt;
  if (above->specular1 == specular) return MappedTexel{above->alpha2, above->specular2};
  if (above == column.begin()) return std::nullopt;
  const TableRow &low = *std::prev(above), &high = *above;
  const double share = (specular - low.specular1) / (high.specular1 - low.specular1);
  return MappedTexel{low.alpha2 + share * (high.alpha2 - low.alpha2),
                     low.specular2 + share * (high.specular2 - low.specular2)};
}

// The columns of `inside` before the width `alpha`, continued to the rows of `beyond` by polynomials in
// width. `keeps_specular`: where the rows are wide, that of the row.
void continue_in_alpha(const std::map<double, Column>& inside, double alpha, const Column& beyond,
                       bool keeps_specular, std::vector<TableRow>* rows) {
  for (TableRow row : beyond) {
    std::array<double, kExtrapolated> at{}, alphas{}, speculars{};
    std::size_t found = 0;
    for (auto column = std::make_reverse_iterator(inside.lower_bound(alpha));
         column != inside.rend() && found < kExtrapolated; ++column)
      if (const auto target = target_in(column->second, row.specular1)) {
        at[found] = column->first;
        alphas[found] = target->alpha;
        speculars[found++] = target->specular;
      }
    if (found < kExtrapolated) continue;
    row.alpha2 = through(at, alphas, alpha);
    if (!(keeps_specular && row.status == RowStatus::kWide)) row.specular2 = through(at, speculars, alpha);
    rows->push_back(row);
  }
}

// The rows of corners that end where the bright regime begins: alpha is at its limit there, and not yet
// beyond.
void add_bright_ends(const Column& column, std::vector<TableRow>* rows) {
  for (std::size_t i = 0; i + 1 < column.size(); ++i)
    if (column[i].status == RowStatus::kCorner && column[i + 1].status == RowStatus::kBright &&
        column[i + 1].specular1 - column[i].specular1 < kSameJoint * column.back().specular1)
      rows->push_back(column[i]);
}

// Where a rising function passes `value`; an end of the range where it does not.
template <typename Function>
double passed_at(const Function& rising, const Range& range, double value) {
  double low = range.min, high = range.max;
  if (!(rising(low) <= value)) return low;
  if (!(rising(high) >= value)) return high;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (rising(middle) < value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::string rows_text(const std::vector<TableRow>& rows) {
  return ", " + std::to_string(rows.size()) + " rows";
}

// The degree in specular that the longest column determines. Rows at a joint count as one.
int specular_degree(const std::map<double, Column>& columns) {
  int most = 0;
  for (const auto& [alpha, column] : columns) {
    int count = 0;
    double last = -1.0;
    for (const TableRow& row : column)
      if (row.specular1 - last > kApart) {
        ++count;
        last = row.specular1;
      }
    most = std::max(most, count);
  }
  return std::max(most - 1, 1);
}

class RegimeFit {
 public:
  RegimeFit(const RegimeRows& rows, const TargetLimits& limits, const MappingKind& mapping,
            const Domain& domain, std::uint64_t seed, std::map<std::string, std::string>* method)
      : rows_(rows), limits_(limits), mapping_(mapping), domain_(domain), seed_(seed), method_(method) {}

  Regimes fit() {
    Regimes regimes;
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
  MappedTexel mapped(double alpha, double specular) const {
    return evaluate_mapping(mapping_, alpha, specular);
  }

  // The width of the source at which the mapping gives `alpha`, between the columns inside and the end of the
  // rows to which it was continued.
  double joint(double specular, double alpha) const {
    const auto [low, high] = std::ranges::minmax_element(rows_.inside, {}, &TableRow::alpha1);
    return passed_at([&](double source) { return mapped(source, specular).alpha; },
                     {low->alpha1, high->alpha1}, alpha);
  }

  // None if the mapping reaches the limit at the very end of the domain.
  std::optional<WideRegime> fit_wide() {
    WideRegime wide{domain_.alpha.min, {domain_.alpha, domain_.specular, {}}};
    wide.specular.alpha.min = domain_.alpha.max;
    for (int i = 0; i < kSpeculars; ++i) {
      const double specular = domain_.specular.max * i / (kSpeculars - 1);
      wide.specular.alpha.min = std::min(wide.specular.alpha.min, joint(specular, limits_.alpha));
      wide.mapping_to = std::max(wide.mapping_to, joint(specular, limits_.alpha * kBeyondLimit));
    }
    if (wide.specular.alpha.max - wide.specular.alpha.min < kLeastWide) return std::nullopt;
    std::vector<TableRow> rows = rows_.wide;
    const std::map<double, Column> columns = columns_of(rows_.wide);
    std::set<double> speculars;
    for (const TableRow& row : rows_.wide) speculars.insert(row.specular1);
    for (const double specular : speculars) {
      TableRow row;
      row.alpha1 = joint(specular, limits_.alpha);
      row.specular1 = specular;
      row.specular2 = mapped(row.alpha1, specular).specular;
      rows.push_back(row);
      // Of two widths, a series knows no product of width and specular: a third one lies on their line.
      const auto target = target_in(columns.begin()->second, specular);
      if (columns.size() > 1 || !target) continue;
      row.alpha1 = 0.5 * (row.alpha1 + columns.begin()->first);
      row.specular2 = 0.5 * (row.specular2 + target->specular);
      rows.push_back(row);
    }
    wide.specular = best_series(rows, std::max<std::size_t>(columns.size() + 1, 3), &TableRow::specular2,
                                wide.specular, series_shapes({kWideSpeculars}), seed_);
    (*method_)["wide"] = series_text(wide.specular) + rows_text(rows);
    return wide;
  }

  // `mapping_to`: the largest width at which the mapping is joined. None if the target reaches the limit of
  // its specular at the very end of the domain.
  std::optional<TexelSeries> fit_bright(double mapping_to) {
    std::vector<TableRow> rows = rows_.bright;
    for (const auto& [alpha, column] : columns_of(rows_.bright)) {
      if (alpha > mapping_to) break;
      const auto rising = [&, width = alpha](double specular) { return mapped(width, specular).specular; };
      const double specular = passed_at(rising, {0.0, domain_.specular.max}, *limits_.specular);
      if (specular == domain_.specular.max) continue;
      TableRow row;
      row.alpha1 = alpha;
      row.specular1 = specular;
      row.alpha2 = mapped(alpha, specular).alpha;
      if (row.alpha2 < limits_.alpha) rows.push_back(row);
    }
    const auto least = [&](double TableRow::*input) {
      return (*std::ranges::min_element(rows, {}, input)).*input;
    };
    const TexelSeries box{{width_before(least(&TableRow::alpha1)), domain_.alpha.max},
                          {least(&TableRow::specular1), domain_.specular.max},
                          {}};
    if (box.specular.max - box.specular.min < kLeastBright * domain_.specular.max) return std::nullopt;
    const std::map<double, Column> columns = columns_of(rows);
    std::vector<SeriesShape> shapes = series_shapes({specular_degree(columns)});
    std::erase_if(shapes, [](const SeriesShape& shape) { return shape.degree > kBrightDegree; });
    const TexelSeries series = best_series(rows, columns.size(), &TableRow::alpha2, box, shapes, seed_);
    (*method_)["bright"] = series_text(series) + rows_text(rows);
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
  const MappingKind& mapping_;
  const Domain& domain_;
  std::uint64_t seed_;
  std::map<std::string, std::string>* method_;
};

}  // namespace

RegimeRows regime_rows(const std::vector<TableRow>& training, const std::vector<TableRow>& all) {
  RegimeRows rows;
  for (const TableRow& row : training) {
    if (row.status == RowStatus::kOk) rows.inside.push_back(row);
    if (row.status == RowStatus::kWide) rows.wide.push_back(row);
    if (row.status == RowStatus::kBright) rows.bright.push_back(row);
  }
  if (rows.bright.size() < kFewestBright || columns_of(rows.bright).size() < kFewestBrightWidths)
    rows.bright.clear();
  const bool has_wide = rows.wide.size() >= kFewestWide;
  if (!has_wide) rows.wide.clear();
  for (const auto& [alpha, column] : columns_of(training)) {
    if (!has_status(column, RowStatus::kWide)) continue_in_specular(column, RowStatus::kOk, &rows.inside);
    if (has_wide) continue_in_specular(column, RowStatus::kWide, &rows.wide);
    if (!rows.bright.empty()) add_bright_ends(column, &rows.bright);
  }
  std::map<double, Column> inside;
  std::size_t continued = 0;
  for (const auto& [alpha, column] : columns_of(all)) {
    Column& own = inside[alpha];
    Column beyond;
    for (const TableRow& row : column) (row.status == RowStatus::kOk ? own : beyond).push_back(row);
    if (!has_status(column, RowStatus::kWide)) {
      continue_in_specular(column, RowStatus::kOk, &own);
      continue;
    }
    if (has_wide && continued == kContinuedWidths) continue;
    if (!has_status(column, RowStatus::kOk)) ++continued;
    continue_in_alpha(inside, alpha, beyond, !has_wide, &rows.inside);
  }
  return rows;
}

Regimes fit_regimes(const RegimeRows& rows, const TargetLimits& limits, const MappingKind& mapping,
                    const Domain& domain, std::uint64_t seed, std::map<std::string, std::string>* method) {
  return RegimeFit(rows, limits, mapping, domain, seed, method).fit();
}

}  // namespace remap
