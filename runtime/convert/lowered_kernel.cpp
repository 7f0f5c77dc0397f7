// The kernels of a lowered mapping, one a file: texel_kernel.inc, compiled for each instruction set.
#include "convert/lowered_kernel.hpp"

#include "convert/instruction_target.hpp"
#include "converter/emitted_order.hpp"

namespace remap {

std::size_t convert_baseline(const LoweredPass& pass, const TexelRows& rows) noexcept;
#if REMAP_HAS_X86_SETS
std::size_t convert_avx2(const LoweredPass& pass, const TexelRows& rows) noexcept;
std::size_t convert_avx512(const LoweredPass& pass, const TexelRows& rows) noexcept;
#endif

OwnedPolynomialRows::OwnedPolynomialRows(const PiecewisePolynomial& polynomial)
    : shape_(polynomial), numbers_(polynomial.coefficients.size()) {
  shape_.coefficients.clear();
  const std::size_t width = polynomial.coefficients_a_cell();
  const std::size_t cells = static_cast<std::size_t>(polynomial.cell_count);
  for (std::size_t cell = 0; cell < cells; ++cell)
    for (std::size_t i = 0; i < width; ++i)
      numbers_[i * cells + cell] = polynomial.coefficients[cell * width + i];
}

PolynomialRows OwnedPolynomialRows::rows() const {
  return {shape_.pole,           shape_.scale,      shape_.start,
          shape_.middle,         shape_.cell_count, static_cast<int>(shape_.degrees.size()),
          shape_.degrees.data(), numbers_.data()};
}

LoweredKernel lowered_kernel(InstructionSet set) {
#if REMAP_HAS_X86_SETS
  if (set == InstructionSet::kAvx512) return &convert_avx512;
  if (set == InstructionSet::kAvx2) return &convert_avx2;
#endif
  static_cast<void>(set);
  return &convert_baseline;
}

}  // namespace remap
