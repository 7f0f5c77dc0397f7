// Rows of texels through the polynomials of a lowered mapping, in floats.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "convert/instruction_set.hpp"
#include "lower/lowered.hpp"
#include "model/fit.hpp"

namespace remap {

// Powers of specular that a polynomial of a pass may have, 0 included.
inline constexpr std::size_t kMostPowers = 16;

// A piecewise polynomial with its numbers ordered as rows of texels read them: for each coefficient, those of
// all cells.
struct PolynomialRows {
  PiecewisePolynomial shape;   // without coefficients
  std::vector<float> numbers;  // [coefficient of a cell][cell]
};
PolynomialRows polynomial_rows(const PiecewisePolynomial& polynomial);

struct LoweredPass {
  RoughnessConvention source = RoughnessConvention::kAlpha;
  RoughnessConvention target = RoughnessConvention::kAlpha;
  float roughness_min = 0.0f, roughness_max = 0.0f;  // of the source's own width parameter
  float specular_min = 0.0f, specular_max = 0.0f;    // from 0; to more than 0
  PolynomialRows alpha;
  PolynomialRows specular;
};

// Converts `count` texels of 1 to 3 channels; the rule for rows is that of Converter::convert. Returns the
// number of texels out of domain.
using LoweredKernel = std::size_t (*)(const LoweredPass& pass, std::size_t count, const float* roughness,
                                      std::span<const float* const> specular, float* roughness_out,
                                      std::span<float* const> specular_out) noexcept;

// For `set`, which the processor must have. Every set computes the same bits.
LoweredKernel lowered_kernel(InstructionSet set);

}  // namespace remap
