// Candidate polynomials for a function: which variable, how many cells, which degrees.
#pragma once

#include <vector>

#include "lower/lowered.hpp"
#include "lower/mapped_function.hpp"
#include "lower/prove.hpp"

namespace remap {

// The values of a function on a dense grid over its domain, finer near alpha 0.
struct SampleGrid {
  std::vector<double> alpha, specular;  // nodes; specular has one where the function does not depend on it
  std::vector<double> values;           // specular fastest
  double largest = 0.0;                 // magnitude
};
SampleGrid sample(const MappedFunction& model, const ProofDomain& domain);

// The largest difference between polynomial (real arithmetic) and samples.
double sampled_error(const PiecewisePolynomial& polynomial, const SampleGrid& samples);

// A shape of polynomial and what it costs.
struct Shape {
  double pole = 0.0;
  int cell_count = 1;
  std::vector<int> degrees;
  double estimate = 0.0;  // of the error; the sum of what was cut from the Chebyshev series
  double cost = 0.0;      // operations a texel, roughly
};

// Shapes are tried by rising size, 0 to size_count() - 1: from one cell of high degree, which vectorises, to
// tables of many cells, which pay for every number that they load. `model` must outlive the finder, which
// keeps the series it has once made.
class ShapeFinder {
 public:
  ShapeFinder(const MappedFunction& model, const ProofDomain& domain);
  std::size_t size_count() const { return magnitudes_.size(); }
  // The shapes of one size: first those whose estimated error is within `tolerance`, the cheapest first, then
  // the others, the closest first.
  std::vector<Shape> shapes(double tolerance, std::size_t size);

 private:
  const MappedFunction& model_;
  ProofDomain domain_;
  // For each size, for each variable, the largest magnitudes of the series: [degree in t][degree in
  // specular].
  std::vector<std::vector<std::vector<std::vector<double>>>> magnitudes_;
};

// The polynomial of a shape: through the Chebyshev series of every cell (Trefethen 2013, chapter 4), cut to
// the shape's degrees; neighbouring cells meet at their joint.
PiecewisePolynomial approximate(const MappedFunction& model, const ProofDomain& domain, const Shape& shape);

}  // namespace remap
