#include "lower/approximate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/number_text.hpp"

namespace remap {
namespace {

constexpr int kMostNodes = 32;  // in t, of one cell
constexpr int kMostSpecularNodes = static_cast<int>(kMostPowers);
constexpr int kMostDegree = 18;  // in one cell: rounding in floats outweighs the gain of more
constexpr std::array<double, 7> kPoles = {0.0, 1.0, 0.3, 0.2, 0.1, 0.05, 0.02};
// Cells, and the highest degree in each. Few cells of high degree vectorise; tables load every coefficient.
struct CellChoice {
  int count;
  int degree;
};
constexpr std::array<CellChoice, 8> kCellChoices = {
    {{1, kMostNodes}, {4, 8}, {8, 6}, {16, 5}, {32, 5}, {64, 4}, {128, 4}, {256, 3}}};

using Matrix = std::vector<std::vector<double>>;  // [degree in t][degree in specular]

// Chebyshev-Lobatto nodes of degree n, from 1 to -1. They include the ends, so that neighbours join.
double node(int k, int degree) { return degree == 0 ? 0.0 : std::cos(std::numbers::pi * k / degree); }

// cos(pi k / n) for 0 <= k < 2 n.
const std::vector<double>& cosines_of(int n) {
  static const auto kAll = [] {
    std::array<std::vector<double>, kMostNodes + 1> all;
    for (int degree = 1; degree <= kMostNodes; ++degree)
      for (int k = 0; k < 2 * degree; ++k)
        all[static_cast<std::size_t>(degree)].push_back(std::cos(std::numbers::pi * k / degree));
    return all;
  }();
  return kAll[static_cast<std::size_t>(n)];
}

// Chebyshev coefficients of the polynomial through values at the nodes of degree n (discrete cosine
// transform of the first kind).
std::vector<double> chebyshev(const std::vector<double>& values) {
  const int n = static_cast<int>(values.size()) - 1;
  if (n == 0) return values;
  const std::vector<double>& cosines = cosines_of(n);
  std::vector<double> series(values.size());
  for (int i = 0; i <= n; ++i) {
    double sum = 0.0;
    for (int k = 0; k <= n; ++k) {
      const double weight = k == 0 || k == n ? 0.5 : 1.0;
      sum +=
          weight * values[static_cast<std::size_t>(k)] * cosines[static_cast<std::size_t>(i * k % (2 * n))];
    }
    series[static_cast<std::size_t>(i)] = sum * (i == 0 || i == n ? 1.0 : 2.0) / n;
  }
  return series;
}

// Coefficients of powers of v from a Chebyshev series in v, |v| <= 1 (Clenshaw's recurrence on polynomials).
std::vector<double> powers(const std::vector<double>& series) {
  std::vector<double> next(series.size(), 0.0), after(series.size(), 0.0);
  for (std::size_t k = series.size(); k-- > 0;) {
    std::vector<double> current(series.size(), 0.0);
    const double factor = k == 0 ? 1.0 : 2.0;
    for (std::size_t i = 0; i + 1 < series.size(); ++i) current[i + 1] = factor * next[i];
    for (std::size_t i = 0; i < series.size(); ++i) current[i] -= after[i];
    current[0] += series[k];
    after = next;
    next = current;
  }
  return next;
}

// Coefficients of powers of x from those of v = x * scale + shift.
std::vector<double> shifted(const std::vector<double>& of_v, double scale, double shift) {
  std::vector<double> result(of_v.size(), 0.0);
  for (std::size_t i = of_v.size(); i-- > 0;) {
    for (std::size_t j = of_v.size(); j-- > 1;) result[j] = result[j] * shift + result[j - 1] * scale;
    result[0] = result[0] * shift + of_v[i];
  }
  return result;
}

// The variable t of a shape and the cells in it.
class Cells {
 public:
  Cells(double pole, int count, const Range& alpha) : pole_(pole) {
    low_ = of_alpha(alpha.min);
    width_ = (of_alpha(alpha.max) - low_) / count;
  }
  double of_alpha(double alpha) const { return pole_ == 0.0 ? alpha : alpha / (alpha + pole_); }
  double alpha_of(double t) const { return pole_ == 0.0 ? t : pole_ * t / (1.0 - t); }
  // t at v in [-1, 1] of a cell.
  double at(int cell, double v) const { return low_ + width_ * (cell + 0.5 + 0.5 * v); }
  double low() const { return low_; }
  double width() const { return width_; }

 private:
  double pole_;
  double low_ = 0.0, width_ = 0.0;
};

// The Chebyshev series of the function in one cell, of degree `n` in t and `m` in specular.
Matrix series_in_cell(const MappedFunction& model, const ProofDomain& domain, const Cells& cells, int cell,
                      int n, int m) {
  Matrix rows(static_cast<std::size_t>(n + 1));
  const double middle = 0.5 * (domain.specular.max + domain.specular.min),
               half = 0.5 * (domain.specular.max - domain.specular.min);
  for (int i = 0; i <= n; ++i) {
    const double alpha =
        std::clamp(cells.alpha_of(cells.at(cell, node(i, n))), domain.alpha.min, domain.alpha.max);
    std::vector<double> values;
    for (int j = 0; j <= m; ++j) values.push_back(model.value(alpha, middle + half * node(j, m)));
    rows[static_cast<std::size_t>(i)] = chebyshev(values);
  }
  for (int j = 0; j <= m; ++j) {
    std::vector<double> column;
    for (const auto& row : rows) column.push_back(row[static_cast<std::size_t>(j)]);
    column = chebyshev(column);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i][static_cast<std::size_t>(j)] = column[i];
  }
  return rows;
}

// Updates the largest magnitude of each entry.
void include(Matrix* largest, const Matrix& series) {
  if (largest->empty()) {
    *largest = series;
    for (auto& row : *largest)
      for (double& entry : row) entry = std::fabs(entry);
    return;
  }
  for (std::size_t i = 0; i < series.size(); ++i)
    for (std::size_t j = 0; j < series[i].size(); ++j)
      (*largest)[i][j] = std::max((*largest)[i][j], std::fabs(series[i][j]));
}

// Adds a straight line to a truncated series so that its ends equal those of the whole series and cells join.
void meet_ends(const Matrix& series, std::size_t j, std::vector<double>* column) {
  double low = 0.0, high = 0.0;
  for (std::size_t i = column->size(); i < series.size(); ++i) {
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    high += series[i][j];
    low += sign * series[i][j];
  }
  column->resize(std::max<std::size_t>(column->size(), 2), 0.0);
  (*column)[0] += 0.5 * (high + low);
  (*column)[1] += 0.5 * (high - low);
}

// Truncates the smallest entries of a series while their sum is within `budget`. Degrees fall with the power
// of specular, because a Chebyshev polynomial of specular contains all lower powers.
std::vector<int> cut(const Matrix& magnitude, double budget, double* dropped) {
  const int n = static_cast<int>(magnitude.size()) - 1, m = static_cast<int>(magnitude[0].size()) - 1;
  std::vector<int> degrees(static_cast<std::size_t>(m + 1), n);
  const auto entry = [&](int i, int j) {
    return magnitude[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  };
  *dropped = 0.0;
  while (true) {
    int best = -1;
    for (int j = 0; j <= m; ++j) {
      const int degree = degrees[static_cast<std::size_t>(j)];
      const int next = j == m ? -1 : degrees[static_cast<std::size_t>(j + 1)];
      if (degree <= next || degree < 0 || (j == 0 && degree == 0)) continue;
      if (best < 0 || entry(degree, j) < entry(degrees[static_cast<std::size_t>(best)], best)) best = j;
    }
    if (best < 0) break;
    const double more = entry(degrees[static_cast<std::size_t>(best)], best);
    if (*dropped + more > budget) break;
    *dropped += more;
    --degrees[static_cast<std::size_t>(best)];
  }
  while (degrees.back() < 0) degrees.pop_back();
  return degrees;
}

// Operations per texel: a product and a sum per coefficient, and eight for its loads from a table; eight for
// a division, and for an index; every power of specular is added for three channels.
double cost_of(const PolynomialShape& shape) {
  const auto count = static_cast<double>(coefficient_count(shape.degrees));
  double cost = 2.0 * count + 6.0 * static_cast<double>(shape.degrees.size() - 1);
  if (shape.pole != 0.0) cost += 8.0;
  if (shape.cell_count > 1) cost += 8.0 + 8.0 * count;
  return cost;
}

// The largest magnitudes of the Chebyshev series over all cells, or over about 64 of them.
Matrix magnitudes_of(const MappedFunction& model, const ProofDomain& domain, double pole,
                     const CellChoice& choice) {
  const Cells cells(pole, choice.count, domain.alpha);
  const int m = model.of_specular ? kMostSpecularNodes - 1 : 0;
  Matrix largest;
  for (int cell = 0; cell < choice.count; cell += std::max(1, choice.count / 64))
    include(&largest, series_in_cell(model, domain, cells, cell, choice.degree, m));
  return largest;
}

PolynomialShape shape_of(const Matrix& largest, double pole, const CellChoice& choice, double tolerance) {
  PolynomialShape shape{pole, choice.count, {}, 0.0, 0.0};
  double dropped = 0.0;
  shape.degrees = cut(largest, 0.8 * tolerance, &dropped);
  if (choice.count > 1)  // at least a straight line, by which cells join
    for (int& degree : shape.degrees) degree = std::max(degree, 1);
  // The last entries estimate the truncation error of the series itself.
  double tail = 0.0;
  for (std::size_t i = 0; i < largest.size(); ++i) tail = std::max(tail, largest[i].back());
  for (const double entry : largest.back()) tail = std::max(tail, entry);
  if (largest[0].size() == 1) tail = largest.back()[0];
  shape.estimate = dropped + tail;
  if (shape.degrees[0] > kMostDegree) {
    for (int i = kMostDegree + 1; i <= shape.degrees[0]; ++i)
      shape.estimate += largest[static_cast<std::size_t>(i)][0];
    for (int& degree : shape.degrees) degree = std::min(degree, kMostDegree);
  }
  shape.cost = cost_of(shape);
  return shape;
}

}  // namespace

SampleGrid sample(const MappedFunction& model, const ProofDomain& domain) {
  constexpr int kAlphas = 480, kSpeculars = 20;
  SampleGrid grid;
  for (int i = 0; i <= kAlphas; ++i) {
    const double q = static_cast<double>(i) / kAlphas;
    grid.alpha.push_back(domain.alpha.min + (domain.alpha.max - domain.alpha.min) * q * q);
  }
  const int speculars = model.of_specular ? kSpeculars : 0;
  for (int j = 0; j <= speculars; ++j)
    grid.specular.push_back(domain.specular.min +
                            (domain.specular.max - domain.specular.min) * j / std::max(speculars, 1));
  for (const double alpha : grid.alpha)
    for (const double specular : grid.specular) {
      grid.values.push_back(model.value(alpha, specular));
      grid.largest = std::max(grid.largest, std::fabs(grid.values.back()));
    }
  return grid;
}

double sampled_error(const PiecewisePolynomial& polynomial, const SampleGrid& samples) {
  double worst = 0.0;
  std::size_t i = 0;
  for (const double alpha : samples.alpha) {
    const int cell = cell_of(polynomial, alpha);
    for (const double specular : samples.specular) {
      const double error = std::fabs(value_in_cell(polynomial, cell, alpha, specular) - samples.values[i++]);
      if (std::isnan(error)) return INFINITY;  // a number overflowed
      worst = std::max(worst, error);
    }
  }
  return worst;
}

ShapeFinder::ShapeFinder(const MappedFunction& model, const ProofDomain& domain)
    : model_(model), domain_(domain), magnitudes_(kCellChoices.size()) {}

std::vector<PolynomialShape> ShapeFinder::shapes(double tolerance, std::size_t size) {
  auto& of_size = magnitudes_[size];
  if (of_size.empty())
    for (const double pole : kPoles)
      of_size.push_back(magnitudes_of(model_, domain_, pole, kCellChoices[size]));
  std::vector<PolynomialShape> all;
  for (std::size_t i = 0; i < kPoles.size(); ++i)
    all.push_back(shape_of(of_size[i], kPoles[i], kCellChoices[size], tolerance));
  const auto first = std::stable_partition(
      all.begin(), all.end(), [&](const PolynomialShape& shape) { return shape.estimate <= tolerance; });
  std::stable_sort(all.begin(), first,
                   [](const PolynomialShape& a, const PolynomialShape& b) { return a.cost < b.cost; });
  std::stable_sort(first, all.end(), [](const PolynomialShape& a, const PolynomialShape& b) {
    return a.estimate < b.estimate;
  });
  return all;
}

PiecewisePolynomial approximate(const MappedFunction& model, const ProofDomain& domain,
                                const PolynomialShape& shape) {
  const Range alpha = domain.alpha;
  const double pole = rounded_to_float(shape.pole);
  const Cells cells(pole, shape.cell_count, alpha);
  PiecewisePolynomial polynomial;
  polynomial.pole = static_cast<float>(pole);
  polynomial.cell_count = shape.cell_count;
  polynomial.degrees = shape.degrees;
  const bool one = shape.cell_count == 1;
  polynomial.scale = one ? 1.0f : static_cast<float>(1.0 / cells.width());
  polynomial.start = one ? static_cast<float>(cells.at(0, 0.0))
                         : static_cast<float>(cells.low() * static_cast<double>(polynomial.scale));
  const double scale = static_cast<double>(polynomial.scale), start = static_cast<double>(polynomial.start);
  const double middle = 0.5 * (domain.specular.max + domain.specular.min),
               half = 0.5 * (domain.specular.max - domain.specular.min);
  const int m = static_cast<int>(shape.degrees.size()) - 1;
  if (m > 1) polynomial.middle = static_cast<float>(middle);
  for (int cell = 0; cell < shape.cell_count; ++cell) {
    const int n = one ? kMostNodes : shape.degrees[0];
    const int specular_nodes = m > 0 ? kMostSpecularNodes - 1 : 0;
    Matrix series = series_in_cell(model, domain, cells, cell, n, specular_nodes);
    // v = 2 (t - cell's middle) / width as a line in u.
    const double u_width = cells.width() * scale;
    const double t_of_u0 = one ? start : (start + cell + 0.5) / scale;
    const double v_of_u0 = 2.0 * (t_of_u0 - cells.at(cell, 0.0)) / cells.width();
    Matrix by_power(static_cast<std::size_t>(m + 1));  // [power of specular][power of u], first in Chebyshev
    for (int j = 0; j <= m; ++j) {
      std::vector<double> column;
      for (int i = 0; i <= shape.degrees[static_cast<std::size_t>(j)]; ++i)
        column.push_back(series[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]);
      if (!one) meet_ends(series, static_cast<std::size_t>(j), &column);
      column = shifted(powers(column), 2.0 / u_width, v_of_u0);
      column.resize(static_cast<std::size_t>(shape.degrees[0] + 1), 0.0);
      by_power[static_cast<std::size_t>(j)] = column;
    }
    for (int i = 0; i <= shape.degrees[0]; ++i) {
      std::vector<double> across;
      for (const auto& column : by_power) across.push_back(column[static_cast<std::size_t>(i)]);
      across = powers(across);
      if (half > 0.0)
        across = shifted(across, 1.0 / half, (static_cast<double>(polynomial.middle) - middle) / half);
      for (std::size_t j = 0; j < across.size(); ++j) by_power[j][static_cast<std::size_t>(i)] = across[j];
    }
    for (int j = 0; j <= m; ++j)
      for (int i = 0; i <= shape.degrees[static_cast<std::size_t>(j)]; ++i)
        polynomial.coefficients.push_back(
            static_cast<float>(by_power[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)]));
  }
  return polynomial;
}

}  // namespace remap
