// The loops over texels, compiled once for each instruction set. Every set gives the same bits, which are
// those of generated headers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "converter/lowered.hpp"
#include "remap/converter.hpp"
#include "remap/model.hpp"
#include "stages/conversion_constants.hpp"
#include "stages/packed_warp.hpp"

#if defined(__x86_64__) && defined(__GNUC__)
#define REMAP_HAS_X86_SETS 1
#else
#define REMAP_HAS_X86_SETS 0
#endif

namespace remap {

// What may be read behind the numbers of a polynomial, which are taken four at a time.
inline constexpr std::size_t kPaddedNumbers = 3;

// A piecewise polynomial as rows of texels read it.
struct PolynomialRows {
  float pole = 0.0f, scale = 1.0f, start = 0.0f, middle = 0.0f;  // as in PiecewisePolynomial
  int cell_count = 1;
  int power_count = 1;
  const int* degrees = nullptr;    // one a power
  const float* numbers = nullptr;  // for each coefficient of a cell, those of all cells
  const float* by_cell = nullptr;  // the same, cell by cell, with kPaddedNumbers behind them
  int cell_stride = 1;
};

// The polynomial of a regime, and where its domain begins.
struct RegimePolynomials {
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
  RegimePolynomials wide, bright;
};

// A polynomial that owns its numbers.
class OwnedPolynomialRows {
 public:
  explicit OwnedPolynomialRows(const PiecewisePolynomial& polynomial);
  // Valid as long as this object stays where it is.
  PolynomialRows rows() const;

 private:
  PiecewisePolynomial shape_;  // with padded coefficients
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

// Rows of the two workflows: diffuse, specular, width; base color, metallic, width.
template <typename Float>
using SpecularRows = std::array<Float*, 7>;
template <typename Float>
using MetallicRows = std::array<Float*, 5>;

// What is found out about a conversion to metallic; rows of `count` texels each.
struct DiagnosisRows {
  float* residual = nullptr;
  float* metallic_width = nullptr;
  float* doubts = nullptr;  // sums of Doubt, over 255
};

// Kernels take rows of any length. An output row may be exactly the input row of the same parameter.
struct Kernels {
  // By a lowered mapping. Returns the number of texels out of domain.
  std::size_t (*convert)(const LoweredPass& pass, const TexelRows& rows) noexcept;

  // From metallic to specular by equation (2), and back by the projection.
  void (*to_specular)(const workflow_code::Conventions& use, std::size_t count,
                      const MetallicRows<const float>& in, const SpecularRows<float>& out) noexcept;
  void (*project)(const workflow_code::Conventions& use, float prior, std::size_t count,
                  const SpecularRows<const float>& in, const MetallicRows<float>& out) noexcept;
  // Of those metallic values whose pictures are within a step of 8 bits of the best, the nearest to `wanted`,
  // with the base color that is best for it: replaces base color and metallic in `result`. Texels whose
  // `wanted` is NaN stay.
  void (*follow)(const workflow_code::Conventions& use, std::size_t count,
                 const SpecularRows<const float>& in, const float* wanted,
                 const MetallicRows<float>& result) noexcept;
  // What diagnose() says of each texel. NaN in the material or in the result: residual and width NaN, no
  // doubt.
  void (*diagnose)(const workflow_code::Conventions& use, std::size_t count,
                   const SpecularRows<const float>& in, const MetallicRows<const float>& result,
                   const DiagnosisRows& out) noexcept;

  // By a compiled warp: rows of diffuse (three), specular (three) and alpha, of the source and of the
  // template. evaluate_warp() to 1e-4. Returns the number of texels with a value that is not in 0 to 1.
  std::size_t (*warp)(const PackedWarp& warp, std::size_t count,
                      const std::array<const float*, kWarpParameters>& in,
                      const std::array<float*, kWarpParameters>& out) noexcept;
};

// For `set`, which the processor must have.
const Kernels& kernels(InstructionSet set);

}  // namespace remap
