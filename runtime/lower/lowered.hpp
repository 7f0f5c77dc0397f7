// A mapping lowered to polynomials on few pieces: what generated headers and texture passes compute in
// floats.
#pragma once

#include <cstddef>
#include <vector>

#include "remap/fit.hpp"

namespace remap {

// How many coefficients polynomials of these degrees have; -1 has none.
std::size_t coefficient_count(const std::vector<int>& degrees);

// A function of alpha and specular: sum over the powers p of c_p(alpha) (specular - middle)^p, every c_p a
// polynomial on cells of equal width in t, with t = alpha, or t = alpha / (alpha + pole), which gives the
// curve near alpha 0 room:
//   x = t * scale - start;  cell = x rounded down, held in [0, cell_count);  u = x - (cell + 1/2)
// for more than one cell, and u = x for one. All numbers are floats, kept in doubles where they are used.
struct PiecewisePolynomial {
  float pole = 0.0f;  // 0: t = alpha
  float scale = 1.0f;
  float start = 0.0f;
  float middle = 0.0f;  // of specular; 0 up to power 1
  int cell_count = 1;
  // Degree of c_p in u, one entry a power from 0; -1: c_p is 0. The last is not -1.
  std::vector<int> degrees;
  // For each cell, for each power, the coefficients of u^0, u^1, ...
  std::vector<float> coefficients;

  std::size_t coefficients_a_cell() const { return coefficient_count(degrees); }
  bool operator==(const PiecewisePolynomial&) const = default;
};

// Powers of specular that the texture pass can evaluate, power 0 included.
inline constexpr std::size_t kMostPowers = 16;

struct LoweredFunction {
  PiecewisePolynomial polynomial;
  double bound = 0.0;    // proven: |polynomial in float arithmetic - model| over the whole domain
  double sampled = 0.0;  // the largest difference on a dense grid, for comparison; below the bound
  // Proven of the polynomial within each cell, in real arithmetic; cells meet but for the rounding of their
  // coefficients.
  bool rises_with_alpha = false;
  bool rises_with_specular = false;  // proven of the polynomial
  bool operator==(const LoweredFunction&) const = default;
};

// A mapping over the domain of its fit. Bounds of specular are in units of target specular, for specular
// within the domain.
struct Lowered {
  LoweredFunction alpha;     // one power of specular where target alpha does not depend on it
  LoweredFunction specular;  // of power 1 alone where the mapping is proportional
  bool operator==(const Lowered&) const = default;
};

// The value in float arithmetic, in the order of operations of the generated header (without contraction):
// even and odd powers of u apart from degree 4, both by Horner's rule.
float value(const PiecewisePolynomial& polynomial, float alpha, float specular);

// The cell of an alpha.
int cell_of(const PiecewisePolynomial& polynomial, double alpha);
// The alpha at which `cell` begins; at cell_count, where the last ends.
double cell_begin(const PiecewisePolynomial& polynomial, int cell);

}  // namespace remap
