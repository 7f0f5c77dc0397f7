// Pictures between pictures: a polynomial in specular through those at a few values of it.
#pragma once

#include <vector>

#include "model/fit.hpp"

namespace remapc {

// `count` points over `range`, both ends included, where polynomials through them stay tame: Chebyshev's of
// the second kind (Trefethen 2013, chapter 2).
std::vector<double> curve_points(const remap::Range& range, std::size_t count);

// The polynomial through `pictures` at `nodes`, at `specular`. The sum of weighted pictures keeps the
// relative precision of each pixel.
std::vector<float> curve_picture(const std::vector<double>& nodes,
                                 const std::vector<std::vector<float>>& pictures, double specular);

}  // namespace remapc
