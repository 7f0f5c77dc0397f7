// A mapping lowered to piecewise polynomials, which generated headers and texture passes evaluate in floats.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace remap {

// The number of coefficients of polynomials of these degrees; degree -1 has none.
std::size_t coefficient_count(const std::vector<int>& degrees);

// A function of alpha and specular: the sum over powers p of c_p(alpha) (specular - middle)^p. Each c_p is a
// polynomial in u on cells of equal width in t, with t = alpha, or t = alpha / (alpha + pole), which spreads
// values near alpha 0:
//   x = t * scale - start;  cell = x rounded down, clamped to [0, cell_count);  u = x - (cell + 1/2)
// for several cells, and u = x for one.
struct PiecewisePolynomial {
  float pole = 0.0f;  // 0: t = alpha
  float scale = 1.0f;
  float start = 0.0f;
  float middle = 0.0f;  // of specular; 0 up to power 1
  int cell_count = 1;
  // Degree of c_p in u, one entry per power from 0; -1: c_p is 0. The last is not -1.
  std::vector<int> degrees;
  // For each cell, for each power, the coefficients of u^0, u^1, ...
  std::vector<float> coefficients;

  std::size_t coefficients_a_cell() const { return coefficient_count(degrees); }
  bool operator==(const PiecewisePolynomial&) const = default;
};

// The number of powers of specular that the texture pass can evaluate, including power 0.
inline constexpr std::size_t kMostPowers = 16;
inline constexpr int kHighestDegree = 64;  // of a polynomial in alpha

struct LoweredFunction {
  PiecewisePolynomial polynomial;
  double bound = 0.0;    // proven: |polynomial in float arithmetic - model| over the whole domain
  double sampled = 0.0;  // the largest difference on a dense grid, below the bound
  // Proven in real arithmetic, for alpha within each cell. Cells join up to the rounding of their
  // coefficients.
  bool rises_with_alpha = false;
  bool rises_with_specular = false;
  bool operator==(const LoweredFunction&) const = default;
};

// The share of a limit over which a regime (model/regimes.hpp) takes over.
inline constexpr double kSeam = 0.005;

// A regime: its function, and where its domain begins, below which a parameter is clamped.
struct LoweredSeries {
  float alpha_from = 0.0f, specular_from = 0.0f;
  LoweredFunction function;
  bool operator==(const LoweredSeries&) const = default;
};
struct LoweredWide {
  float mapping_to = 1.0f;
  LoweredSeries specular;
  bool operator==(const LoweredWide&) const = default;
};

// A fit over its domain. Bounds of specular are in units of target specular, for specular within the domain.
struct Lowered {
  LoweredFunction alpha;     // one power of specular if target alpha does not depend on it
  LoweredFunction specular;  // power 1 alone if the mapping is proportional
  // Set where a polynomial may pass the limit, which then holds what it gives.
  std::optional<float> alpha_limit, specular_limit;
  std::optional<LoweredWide> wide;
  std::optional<LoweredSeries> bright;  // target alpha
  // What the errors of the shares add where one regime takes over from another, found by sampling.
  double alpha_seam = 0.0, specular_seam = 0.0;
  bool operator==(const Lowered&) const = default;

  bool has_limits() const { return alpha_limit.has_value() || specular_limit.has_value(); }
  // Bounds over all regimes.
  double alpha_bound() const;
  double specular_bound() const;
};

// The value in float arithmetic, in the order of operations of the generated header without contraction.
float value(const PiecewisePolynomial& polynomial, float alpha, float specular);

int cell_of(const PiecewisePolynomial& polynomial, double alpha);
// The alpha at which `cell` begins; for cell_count, the end of the last.
double cell_begin(const PiecewisePolynomial& polynomial, int cell);

}  // namespace remap
