// This file implements Taylor models (Makino and Berz 2003). A Taylor model is a polynomial over a box, and a
// proven bound on the error of the polynomial. If a function of lower/evaluate.hpp is applied to Taylor
// models, the result encloses the function over the whole box, including rounding errors. Lowering proves its
// error bounds in this way.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "lower/evaluate.hpp"

namespace remap {

// A Taylor is a polynomial of total degree `Order` in 1 or 2 variables, each in [-1, 1] over the box.
// Everywhere in the box, the enclosed function differs from the polynomial by at most `rest`. After an
// overflow, and if the function is unbounded, `rest` is infinite or NaN, so the model states nothing.
template <int Variables, int Order>
class Taylor {
  static_assert(Variables == 1 || Variables == 2);

 public:
  static constexpr int kCount = Variables == 1 ? Order + 1 : (Order + 1) * (Order + 2) / 2;
  static constexpr double kUnit = 2.3e-16;  // slightly above the unit roundoff of a double
  static constexpr double kRoundUp = 1.0 + (kCount + 2) * kUnit;

  Taylor() = default;
  explicit Taylor(double constant) { coefficients_[0] = constant; }
  // Returns centre + half_width * variable.
  static Taylor variable(int variable, double centre, double half_width) {
    Taylor result(centre);
    result.coefficients_[static_cast<std::size_t>(1 + variable)] = half_width;
    result.rest_ = kUnit * (std::fabs(centre) + half_width);
    return result;
  }
  // Returns a model that states nothing.
  static Taylor unbounded() {
    Taylor result;
    result.rest_ = std::numeric_limits<double>::infinity();
    return result;
  }

  double constant() const { return coefficients_[0]; }
  double linear(int variable) const { return coefficients_[static_cast<std::size_t>(1 + variable)]; }
  double rest() const { return rest_; }
  void widen(double by) { rest_ += by; }
  // Returns the coefficient of the monomial (i, j), i + j <= Order; j is 0 with one variable.
  double& at(int i, int j) { return coefficients_[index(i, j)]; }
  double at(int i, int j) const { return coefficients_[index(i, j)]; }

  // Return bounds: the function differs from the constant by at most `deviation`, and is at most `bound` in
  // magnitude. Both are rounded up, because they are sums.
  double deviation() const { return (norm(1) + rest_) * kRoundUp; }
  double bound() const { return (norm(0) + rest_) * kRoundUp; }
  // Returns the sum of the magnitudes of one variable's pure powers: the weight of that direction.
  double extent(int variable) const {
    double sum = 0.0;
    for (int d = 1; d <= Order; ++d)
      sum += std::fabs(variable == 0 ? coefficients_[index(d, 0)] : coefficients_[index(0, d)]);
    return sum;
  }

  friend Taylor operator+(const Taylor& a, const Taylor& b) {
    Taylor result;
    for (std::size_t k = 0; k < kCount; ++k)
      result.coefficients_[k] = a.coefficients_[k] + b.coefficients_[k];
    result.rest_ = a.rest_ + b.rest_ + kUnit * result.norm(0);
    return result;
  }
  friend Taylor operator-(const Taylor& a, const Taylor& b) { return a + b * -1.0; }
  friend Taylor operator+(Taylor a, double b) {
    a.coefficients_[0] += b;
    a.rest_ += kUnit * (std::fabs(a.coefficients_[0]) + std::fabs(b));
    return a;
  }
  friend Taylor operator-(const Taylor& a, double b) { return a + -b; }
  friend Taylor operator*(Taylor a, double b) {
    for (double& coefficient : a.coefficients_) coefficient *= b;
    a.rest_ = a.rest_ * std::fabs(b) * (1.0 + kUnit) + kUnit * a.norm(0);
    return a;
  }
  friend Taylor operator*(const Taylor& a, const Taylor& b) { return product(a, b); }

  // Returns the sum of series[k] (x - x's constant)^k. `rest` bounds the remainder of the series.
  static Taylor compose(const Taylor& x, const std::array<double, Order + 1>& series, double rest) {
    Taylor deviation = x;
    deviation.coefficients_[0] = 0.0;
    Taylor result(series[Order]);
    for (int k = Order; k-- > 0;) result = result * deviation + series[static_cast<std::size_t>(k)];
    result.rest_ += rest;
    return result;
  }

 private:
  static constexpr std::size_t index(int i, int j) {
    if constexpr (Variables == 1) {
      return static_cast<std::size_t>(i);
    } else {
      const int degree = i + j;
      return static_cast<std::size_t>(degree * (degree + 1) / 2 + j);
    }
  }
  static constexpr int size_of(int degree) { return Variables == 1 ? 1 : degree + 1; }
  static constexpr std::size_t first_of(int degree) { return index(degree, 0); }

  // Return the sum of the magnitudes of coefficients: from a degree on, and of one degree.
  double norm(int from) const {
    double sum = 0.0;
    for (std::size_t k = first_of(from); k < kCount; ++k) sum += std::fabs(coefficients_[k]);
    return sum;
  }
  std::array<double, Order + 1> norms() const {
    std::array<double, Order + 1> sums{};
    for (int d = 0; d <= Order; ++d)
      for (int j = 0; j < size_of(d); ++j)
        sums[static_cast<std::size_t>(d)] +=
            std::fabs(coefficients_[first_of(d) + static_cast<std::size_t>(j)]);
    return sums;
  }

  static Taylor product(const Taylor& a, const Taylor& b) {
    Taylor result;
    for (int e = 0; e <= Order; ++e)
      for (int j = 0; j < size_of(e); ++j) {
        const double factor = b.coefficients_[first_of(e) + static_cast<std::size_t>(j)];
        if (factor == 0.0) continue;  // most coefficients of a variable are 0
        for (int d = 0; d + e <= Order; ++d)
          for (int i = 0; i < size_of(d); ++i)
            result.coefficients_[first_of(d + e) + static_cast<std::size_t>(i + j)] +=
                a.coefficients_[first_of(d) + static_cast<std::size_t>(i)] * factor;
      }
    const auto in_a = a.norms(), in_b = b.norms();
    double dropped = 0.0, total_a = 0.0, total_b = 0.0, tail_b = 0.0;
    for (int d = 0; d <= Order; ++d) {  // degree d of a times degrees above Order - d of b
      dropped += in_a[static_cast<std::size_t>(d)] * tail_b;
      tail_b += in_b[static_cast<std::size_t>(Order - d)];
      total_a += in_a[static_cast<std::size_t>(d)];
      total_b += in_b[static_cast<std::size_t>(d)];
    }
    result.rest_ = dropped + total_a * b.rest_ + total_b * a.rest_ + a.rest_ * b.rest_ +
                   kCount * kUnit * total_a * total_b;
    return result;
  }

  std::array<double, kCount> coefficients_{};
  double rest_ = 0.0;
};

// evaluate.hpp needs the following functions. The series use the constant x0 of the argument, y = x - x0, |y|
// <= r. The remainder is bounded by Lagrange's form or by Cauchy's estimate, as each function states.

// Uses phi(x0 + y) = phi(x0) + exp(-rate x0) sum of (-rate)^(k-1) y^k / k!; Lagrange, largest at x0 - r.
template <int V, int N>
Taylor<V, N> rise(double rate, const Taylor<V, N>& x) {
  if (rate == 0.0) return x;
  std::array<double, N + 1> series{};
  series[0] = rise(rate, x.constant());
  double term = std::exp(-rate * x.constant());
  double left = std::exp(-rate * (x.constant() - x.deviation()));
  for (int k = 1; k <= N; ++k) {
    term /= k;
    series[static_cast<std::size_t>(k)] = term;
    left *= rate * x.deviation() / k;
    term *= -rate;
  }
  left *= x.deviation() / (N + 1);
  // The coefficients round in proportion to the argument of exp. Their sum belongs to a function that is
  // below 1 / rate, and below x if the rate is small. z exp(-z) is below 1.
  return Taylor<V, N>::compose(x, series,
                               left * (1.0 + 1e-12) + 4e-15 * (std::fabs(series[0]) + x.deviation()));
}

// Uses 1 / (x0 + y) = sum of (-y)^k / x0^(k+1), a geometric series.
template <int V, int N>
Taylor<V, N> reciprocal(const Taylor<V, N>& x) {
  const double x0 = x.constant(), r = x.deviation();
  if (!(r < std::fabs(x0))) return Taylor<V, N>::unbounded();
  std::array<double, N + 1> series{};
  double term = 1.0 / x0, left = 1.0 / (std::fabs(x0) - r);
  for (double& coefficient : series) {
    coefficient = term;
    term *= -1.0 / x0;
    left *= r / std::fabs(x0);
  }
  return Taylor<V, N>::compose(x, series, left * (1.0 + 1e-6) + 2e-14 / std::fabs(x0));
}

// The coefficients come from tanh' = 1 - tanh^2. On a disc of radius 1 around a real number, |tanh| <=
// tan(1). So by Cauchy, the k-th coefficient is at most tan(1). If the argument has a wide range, only the
// values at its ends enclose the result.
template <int V, int N>
Taylor<V, N> hyperbolic_tangent(const Taylor<V, N>& x) {
  const double x0 = x.constant(), r = x.deviation();
  if (r > 0.5) {
    const double low = std::tanh(x0 - r), high = std::tanh(x0 + r);
    Taylor<V, N> result(0.5 * (low + high));
    result.widen(0.5 * (high - low) + 1e-15);
    return result;
  }
  std::array<double, N + 1> series{};
  series[0] = std::tanh(x0);
  for (int k = 0; k < N; ++k) {
    double square = 0.0;  // coefficient k of tanh^2
    for (int i = 0; i <= k; ++i)
      square += series[static_cast<std::size_t>(i)] * series[static_cast<std::size_t>(k - i)];
    series[static_cast<std::size_t>(k + 1)] = ((k == 0 ? 1.0 : 0.0) - square) / (k + 1);
  }
  const double left = 1.5575 * std::pow(r, N + 1) / (1.0 - r);
  return Taylor<V, N>::compose(x, series, left + 1e-15);
}

// Over [l, u] around 0, max(x, 0) lies between the chord u (x - l) / (u - l) and the same chord lowered by -l
// u / (u - l).
template <int V, int N>
Taylor<V, N> rectified(const Taylor<V, N>& x) {
  const double low = x.constant() - x.deviation(), high = x.constant() + x.deviation();
  if (low >= 0.0) return x;
  if (high <= 0.0) return Taylor<V, N>(0.0);
  const double slope = high / (high - low), half = -0.5 * slope * low;
  Taylor<V, N> result = x * slope + half;
  result.widen(half * (1.0 + 1e-12));
  return result;
}

// Encloses exp(-gamma (d + h u)^2) for u in [-1, 1], where d = x0 - v. The result is height exp(p) with p = a
// u + b u^2, and (exp p)' = p' exp p gives its coefficients. By Cauchy, on a disc of radius R the rest is at
// most M R^-(N+1) / (1 - 1 / R) with M = height exp(|a| R + |b| R^2). The rest is computed in logarithms,
// because height may underflow.
template <int N>
struct GaussianSeries {
  std::array<double, N + 1> coefficients{};
  double total = 0.0;     // sum of magnitudes, and the remainder
  double rounding = 0.0;  // bound of the sum of the rounding errors of all coefficients

  GaussianSeries(double gamma, double distance, double half_width) {
    constexpr double kUnit = Taylor<1, N>::kUnit;
    const double a = -2.0 * gamma * distance * half_width, b = -gamma * half_width * half_width;
    const double exponent = gamma * distance * distance;
    const double height = std::exp(-exponent);
    // Terms of the recurrence have different signs. The same recurrence with magnitudes bounds its rounding.
    std::array<double, N + 1> unsigned_coefficients{};
    coefficients[0] = unsigned_coefficients[0] = height;
    for (std::size_t k = 1; k <= N; ++k) {
      const double inverse = 1.0 / static_cast<double>(k);
      coefficients[k] = (a * coefficients[k - 1] + (k > 1 ? 2.0 * b * coefficients[k - 2] : 0.0)) * inverse;
      unsigned_coefficients[k] = (std::fabs(a) * unsigned_coefficients[k - 1] -
                                  (k > 1 ? 2.0 * b * unsigned_coefficients[k - 2] : 0.0)) *
                                 inverse;
    }
    const double radius =
        std::clamp((N + 1) / (std::fabs(a) + std::sqrt(2.0 * (N + 1) * -b) + 1e-30), 1.5, 64.0);
    const double largest = std::fabs(a) * radius - b * radius * radius - exponent;
    const double left = std::exp(largest) * std::pow(radius, -(N + 1)) / (1.0 - 1.0 / radius);
    for (std::size_t k = 0; k <= N; ++k) {
      total += std::fabs(coefficients[k]);
      rounding += unsigned_coefficients[k];
    }
    // The rounding error of `height` comes from its exponent. One step of the recurrence has eight
    // operations.
    rounding *= kUnit * (8.0 * N + 4.0 + 4.0 * exponent);
    // The rounding error of exp(largest) comes from its exponent, too.
    total = (total + left * (1.0 + 1e-12 * (1.0 + exponent + std::fabs(largest)))) * (1.0 + 1e-14);
    // If the series is not accurate, use only the values: from 0 to the value at the closest point.
    const double nearest = std::max(0.0, std::fabs(distance) - half_width);
    const double peak = std::min(1.0, std::exp(-gamma * nearest * nearest) * (1.0 + 1e-9));
    if (total <= 2.0 * peak || !std::isfinite(distance) || !std::isfinite(half_width)) return;
    coefficients = {0.5 * peak};
    total = peak;
    rounding = 0.0;
  }
};

// Holds the sum as a polynomial in the deviations of the inputs from their constants. The inputs are inserted
// last.
template <int V, int N>
Taylor<V, N> gaussian_sum(const KernelExpansion& expansion, const std::vector<Taylor<V, N>>& inputs) {
  std::array<std::array<double, N + 1>, N + 1> sums{};  // [power of input 0][power of input 1]
  double left = 0.0;
  const bool two = inputs.size() == 2;
  const double summing = Taylor<V, N>::kUnit * (4.0 + static_cast<double>(expansion.count()));
  const double* vector = expansion.vectors.data();
  for (const double weight : expansion.weights) {
    const GaussianSeries<N> x(expansion.gamma, inputs[0].constant() - vector[0], inputs[0].deviation());
    const GaussianSeries<N> y(expansion.gamma, two ? inputs[1].constant() - vector[1] : 0.0,
                              two ? inputs[1].deviation() : 0.0);
    vector += inputs.size();
    double kept = 0.0;
    for (std::size_t i = 0; i <= N; ++i)
      for (std::size_t j = 0; i + j <= (two ? N : i); ++j) {
        const double term = x.coefficients[i] * y.coefficients[j];
        sums[i][j] += weight * term;
        kept += std::fabs(term);
      }
    const double total = x.total * y.total;
    // std::max would drop a NaN.
    const double unkept = total - kept < 0.0 ? 0.0 : total - kept;
    left += std::fabs(weight) * (unkept + summing * total + x.rounding * y.total + x.total * y.rounding +
                                 1e-300);  // lost by underflow
  }
  // Divides deviations by their largest values, because the series need them within [-1, 1].
  const auto unit = [](const Taylor<V, N>& input) {
    return (input - input.constant()) * (1.0 / std::max(input.deviation(), 1e-300));
  };
  const Taylor<V, N> u = unit(inputs[0]), v = two ? unit(inputs[1]) : Taylor<V, N>(0.0);
  Taylor<V, N> sum(0.0);
  for (std::size_t i = N + 1; i-- > 0;) {
    Taylor<V, N> row(0.0);
    for (std::size_t j = two ? N + 1 - i : 1; j-- > 0;) row = row * v + sums[i][j];
    sum = sum * u + row;
  }
  sum.widen(left);
  return sum;
}

}  // namespace remap
