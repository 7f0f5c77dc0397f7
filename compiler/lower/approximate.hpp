// Candidate polynomials for a function: their variable, number of cells, and degrees.
#pragma once

#include <vector>

#include "converter/lowered.hpp"
#include "lower/prove.hpp"

namespace remap {

// The values of a function on a dense grid over its domain, finer near alpha 0.
struct SampleGrid {
  std::vector<double> alpha, specular;  // nodes; one of specular if the function does not depend on it
  std::vector<double> values;           // specular fastest
  double largest = 0.0;                 // magnitude
};
SampleGrid sample(const MappedFunction& model, const ProofDomain& domain);

// The largest difference between the polynomial in real arithmetic and the samples.
double sampled_error(const PiecewisePolynomial& polynomial, const SampleGrid& samples);

struct PolynomialShape {
  double pole = 0.0;
  int cell_count = 1;
  std::vector<int> degrees;
  double estimate = 0.0;  // of the error: the sum of the truncated Chebyshev coefficients
  double cost = 0.0;      // operations per texel, roughly
};

// Shapes are tried in order of size, 0 to size_count() - 1: from one cell of high degree, which vectorises,
// to tables of many cells, in which every coefficient is loaded. `model` must outlive the finder, which
// caches series.
class ShapeFinder {
 public:
  ShapeFinder(const MappedFunction& model, const ProofDomain& domain);
  std::size_t size_count() const { return magnitudes_.size(); }
  // The shapes of one size: first those whose estimated error is within `tolerance`, by cost, then the others
  // by error.
  std::vector<PolynomialShape> shapes(double tolerance, std::size_t size);

 private:
  const MappedFunction& model_;
  ProofDomain domain_;
  // For each size, for each variable, the largest magnitudes of the series: [degree in t][degree in
  // specular].
  std::vector<std::vector<std::vector<std::vector<double>>>> magnitudes_;
};

// The polynomial of a shape: the Chebyshev series of every cell (Trefethen 2013, chapter 4), truncated to the
// shape's degrees. Neighbouring cells join continuously.
PiecewisePolynomial approximate(const MappedFunction& model, const ProofDomain& domain,
                                const PolynomialShape& shape);

}  // namespace remap
