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
// How far the mapping passes the limit of alpha before it is held: more than its lowering may change.
constexpr double kBeyondLimit = 5e-4;
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

// The value at `x` of the parabola through three points.
double parabola(const std::array<double, 3>& at, const std::array<double, 3>& values, double x) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    double term = values[i];
    for (std::size_t j = 0; j < 3; ++j)
      if (j != i) term *= (x - at[j]) / (at[i] - at[j]);
    sum += term;
  }
  return sum;
}

// The columns inside, continued to the first wide ones by parabolas through their last three rows of a specular;
// `keeps_specular`: in width alone.
void continue_in_alpha(const std::map<double, Column>& inside, const std::map<double, Column>& wide,
                       bool keeps_specular, std::vector<TableRow>* rows) {
  std::size_t done = 0;
  for (const auto& [alpha, column] : wide) {
    if (done == kContinuedWidths) break;
    ++done;
    for (TableRow row : column) {
      std::vector<const TableRow*> neighbours;
      for (auto other = inside.rbegin(); other != inside.rend() && neighbours.size() < 3; ++other)
        for (const TableRow& candidate : other->second)
          if (other->first < alpha && std::fabs(candidate.specular1 - row.specular1) < kSameSpecular)
            neighbours.push_back(&candidate);
      if (neighbours.size() < 3) continue;
      std::array<double, 3> at{}, alphas{}, speculars{};
      for (std::size_t i = 0; i < 3; ++i) {
        at[i] = neighbours[i]->alpha1;
        alphas[i] = neighbours[i]->alpha2;
        speculars[i] = neighbours[i]->specular2;
      }
      row.alpha2 = parabola(at, alphas, alpha);
      if (!keeps_specular) row.specular2 = parabola(at, speculars, alpha);
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

// The columns continued to specular `from` by the line through their first two rows, so that a network that bends in
// the corner without rows does not need a large table.
void continue_downwards(double from, std::vector<TableRow>* rows) {
  std::vector<TableRow> more;
  for (const auto& [alpha, column] : columns_of(*rows)) {
    const double room = column.front().specular1 - from;
    if (column.size() < 2 || !(room > 0.0)) continue;
    const std::size_t next = column.size() / 3 + 1 < column.size() ? column.size() / 3 + 1 : column.size() - 1;
    const double slope = (column[next].alpha2 - column[0].alpha2) / (column[next].specular1 - column[0].specular1);
    for (int i = 1; i <= kContinuedSpeculars; ++i) {
      TableRow row = column.front();
      row.specular1 -= room * i / kContinuedSpeculars;
      row.alpha2 += slope * (row.specular1 - column.front().specular1);
      more.push_back(row);
    }
  }
  rows->insert(rows->end(), more.begin(), more.end());
}

Samples samples_of(const std::vector<TableRow>& rows) {
  Samples samples{2, 1, {}, {}};
  for (const TableRow& row : rows) {
    samples.inputs.insert(samples.inputs.end(), {row.alpha1, row.specular1});
    samples.outputs.push_back(row.alpha2);
  }
  return samples;
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

// The polynomial of least squares: powers of specular up to `speculars`, of alpha up to `alphas`.
remap::TexelPolynomial fitted_polynomial(const std::vector<TableRow>& rows, int alphas, int speculars) {
  const Eigen::Index width = alphas + 1, count = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd basis(count, width * (speculars + 1));
  Eigen::VectorXd values(count);
  for (Eigen::Index r = 0; r < count; ++r) {
    const TableRow& row = rows[static_cast<std::size_t>(r)];
    values(r) = row.specular2;
    for (int j = 0; j <= speculars; ++j)
      for (int i = 0; i <= alphas; ++i)
        basis(r, j * width + i) = std::pow(row.specular1, j) * std::pow(row.alpha1, i);
  }
  const Eigen::VectorXd found = basis.colPivHouseholderQr().solve(values);
  remap::TexelPolynomial polynomial;
  for (int j = 0; j <= speculars; ++j)
    polynomial.emplace_back(found.data() + j * width, found.data() + (j + 1) * width);
  return polynomial;
}

struct PolynomialShape {
  int alphas, speculars;
};

// By rising size.
constexpr std::array<PolynomialShape, 8> kShapes = {
    {{1, 1}, {2, 1}, {3, 1}, {2, 2}, {4, 1}, {3, 2}, {4, 2}, {6, 2}}};

// The smallest shape that counts as equal to the best in cross-validation (folds.hpp).
PolynomialShape chosen_shape(const std::vector<TableRow>& rows, std::uint64_t seed) {
  constexpr std::size_t kShapeFolds = 5;
  const std::vector<Fold> folds = split_folds(rows, kShapeFolds, seed);
  std::vector<CrossValidated> scores;
  for (const PolynomialShape& shape : kShapes) {
    std::vector<std::vector<double>> errors;
    for (const Fold& fold : folds) {
      const remap::TexelPolynomial polynomial = fitted_polynomial(fold.training, shape.alphas, shape.speculars);
      errors.emplace_back();
      for (const TableRow& row : fold.judging)
        errors.back().push_back(remap::polynomial_value(polynomial, row.alpha1, row.specular1) - row.specular2);
    }
    scores.push_back(cross_validated(errors));
  }
  const double bound = error_bound(scores);
  for (std::size_t i = 0; i < kShapes.size(); ++i)
    if (scores[i].rms <= bound) return kShapes[i];
  return kShapes.back();
}

class RegimeFit {
 public:
  RegimeFit(const RegimeRows& rows, const TargetLimits& limits, const remap::MappingKind& mapping,
            const remap::Domain& domain, const MlpOptions& options,
            std::map<std::string, std::string>* method)
      : rows_(rows), limits_(limits), mapping_(mapping), domain_(domain), options_(options), method_(method) {}

  remap::Regimes fit(const FitProgress& progress) {
    remap::Regimes regimes;
    regimes.alpha_limit = limits_.alpha;
    regimes.specular_limit = limits_.specular;
    if (!rows_.wide.empty()) regimes.wide = fit_wide();
    if (!rows_.bright.empty()) {
      const double to = regimes.wide ? regimes.wide->from : domain_.alpha.max;
      regimes.bright = fit_bright(to, progress);
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
    remap::WideRegime wide{domain_.alpha.max, domain_.alpha.min, {}};
    for (int i = 0; i < kSpeculars; ++i) {
      const double specular = domain_.specular.max * i / (kSpeculars - 1);
      const auto from = joint(specular, limits_.alpha), to = joint(specular, limits_.alpha + kBeyondLimit);
      if (!from || !to) return std::nullopt;
      wide.from = std::min(wide.from, *from);
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
    const PolynomialShape shape = chosen_shape(rows, options_.seed);
    wide.specular = fitted_polynomial(rows, shape.alphas, shape.speculars);
    (*method_)["wide"] = "degree " + std::to_string(shape.alphas) + " in alpha, " +
                         std::to_string(shape.speculars) + " in specular, " + std::to_string(rows.size()) + " rows";
    return wide;
  }

  // `mapping_to`: the largest width at which the mapping is joined.
  remap::BrightRegime fit_bright(double mapping_to, const FitProgress& progress) {
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
    const double specular_from = std::ranges::min_element(rows, {}, &TableRow::specular1)->specular1;
    const double alpha_from = std::ranges::min_element(rows, {}, &TableRow::alpha1)->alpha1;
    continue_downwards(specular_from, &rows);
    const TrainedNetwork network = train_network(samples_of(rows), options_, progress);
    (*method_)["bright"] = network.method;
    return {alpha_from, specular_from, network.network};
  }

  const RegimeRows& rows_;
  const TargetLimits& limits_;
  const remap::MappingKind& mapping_;
  const remap::Domain& domain_;
  const MlpOptions& options_;
  std::map<std::string, std::string>* method_;
};

}  // namespace

RegimeRows regime_rows(const std::vector<TableRow>& training, const TargetLimits& limits) {
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
  const std::map<double, Column> inside = columns_of(rows.inside), wide = columns_of(rows.wide);
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
                           const remap::Domain& domain, const MlpOptions& options,
                           std::map<std::string, std::string>* method, const FitProgress& progress) {
  return RegimeFit(rows, limits, mapping, domain, options, method).fit(progress);
}

}  // namespace remapc
