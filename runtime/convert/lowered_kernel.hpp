// Rows of texels through the polynomials of a lowered mapping, in floats.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "converter/lowered.hpp"
#include "remap/converter.hpp"
#include "remap/model.hpp"

namespace remap {

// A piecewise polynomial as rows of texels read it.
struct PolynomialRows {
  float pole = 0.0f, scale = 1.0f, start = 0.0f, middle = 0.0f;  // as in PiecewisePolynomial
  int cell_count = 1;
  int power_count = 1;
  const int* degrees = nullptr;    // one a power
  const float* numbers = nullptr;  // for each coefficient of a cell, those of all cells
};

// The polynomial of a regime, and where its domain begins.
struct RegimeRows {
  float alpha_from = 0.0f, specular_from = 0.0f;
  PolynomialRows polynomial;
};

// The loops of a pass, from the fastest.
enum class LoweredForm {
  kProportional,  // target specular is a factor times specular, target alpha free of it
  kTerms,
  kRegimes,  // a limit of the target may hold what a polynomial gives
};

// What a kernel is told of a converter.
struct LoweredPass {
  RoughnessConvention source = RoughnessConvention::kAlpha;
  RoughnessConvention target = RoughnessConvention::kAlpha;
  float roughness_min = 0.0f, roughness_max = 0.0f;  // of the source's own width parameter
  float specular_min = 0.0f, specular_max = 0.0f;    // from 0; to more than 0
  float inverse_specular_max = 1.0f;
  LoweredForm form = LoweredForm::kTerms;
  PolynomialRows alpha;
  PolynomialRows specular;
  // Of kRegimes: the largest float where there is no limit, without degrees where there is no regime
  // (converter/lowered.hpp).
  float alpha_limit = 0.0f, specular_limit = 0.0f, mapping_to = 0.0f;
  RegimeRows wide, bright;
};

// A polynomial that owns its numbers.
class OwnedPolynomialRows {
 public:
  explicit OwnedPolynomialRows(const PiecewisePolynomial& polynomial);
  // Valid as long as this object stays where it is.
  PolynomialRows rows() const;

 private:
  PiecewisePolynomial shape_;  // without coefficients
  std::vector<float> numbers_;
};

// Rows of `count` texels. An output row may be exactly its input row.
struct TexelRows {
  std::size_t count = 0;
  std::size_t channels = 1;  // 1 or 3
  const float* roughness = nullptr;
  std::array<const float*, 3> specular{};
  float* roughness_out = nullptr;
  std::array<float*, 3> specular_out{};
  std::uint8_t* outside = nullptr;  // 1 for each texel out of domain, else 0; null: nobody asks
};

// Converts the rows; returns the number of texels out of domain.
using LoweredKernel = std::size_t (*)(const LoweredPass& pass, const TexelRows& rows) noexcept;

// For `set`, which the processor must have. Every set computes the same bits, those of the generated header.
LoweredKernel lowered_kernel(InstructionSet set);

}  // namespace remap
