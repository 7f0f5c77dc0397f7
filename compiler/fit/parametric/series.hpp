// Chebyshev series of width and specular by least squares. Errors count by error_weight() (regression.hpp).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "table/regression.hpp"

namespace remap {

// The sum of the degrees of a term is at most `degree`, that in specular at most `of_specular`.
struct SeriesShape {
  int degree = 0, of_specular = 0;
  std::size_t count() const;  // of coefficients
  bool operator==(const SeriesShape&) const = default;
};

// Every degree that is tried, with at most `of_specular` in specular, by rising number of coefficients.
std::vector<SeriesShape> series_shapes(const std::vector<int>& of_specular);
inline constexpr int kAnyDegree = 1000;

// `rows` by `output` over the box of `series`. A small ridge keeps the part of the box without rows bounded.
TexelSeries fit_series(const std::vector<TableRow>& rows, double TableRow::*output, TexelSeries series,
                       const SeriesShape& shape);

// The choice among `shapes` by cross-validation (choice.hpp). `widths`: the
// number of different alpha1 among the rows, which a degree stays below. Throws kNumeric if none has finite
// errors, as over a box without extent.
TexelSeries best_series(const std::vector<TableRow>& rows, std::size_t widths, double TableRow::*output,
                        const TexelSeries& box, const std::vector<SeriesShape>& shapes, std::uint64_t seed);

std::string series_text(const TexelSeries& series);

// Kind `series` over `domain`. Target alpha is fitted from source alpha alone unless alpha_needs_specular(),
// or unless that is off by more than 1e-3 (relative, rms). Throws kInput for fewer than 10 rows or a constant
// input.
Regression fit_series_kind(const std::vector<TableRow>& rows, const Domain& domain, std::uint64_t seed);

}  // namespace remap
