#include "stages/kernels.hpp"

namespace remap {

extern const Kernels baseline_kernels;
#if REMAP_HAS_X86_SETS
extern const Kernels avx2_kernels, avx512_kernels;
#endif

OwnedPolynomialRows::OwnedPolynomialRows(const PiecewisePolynomial& polynomial)
    : shape_(polynomial), numbers_(polynomial.coefficients.size()) {
  shape_.coefficients.resize(polynomial.coefficients.size() + kPaddedNumbers);
  const std::size_t width = polynomial.coefficients_a_cell();
  const std::size_t cells = static_cast<std::size_t>(polynomial.cell_count);
  for (std::size_t cell = 0; cell < cells; ++cell)
    for (std::size_t i = 0; i < width; ++i)
      numbers_[i * cells + cell] = polynomial.coefficients[cell * width + i];
}

PolynomialRows OwnedPolynomialRows::rows() const {
  return {shape_.pole,
          shape_.scale,
          shape_.start,
          shape_.middle,
          shape_.cell_count,
          static_cast<int>(shape_.degrees.size()),
          shape_.degrees.data(),
          numbers_.data(),
          shape_.coefficients.data(),
          static_cast<int>(shape_.coefficients_a_cell())};
}

const Kernels& kernels(InstructionSet set) {
#if REMAP_HAS_X86_SETS
  if (set == InstructionSet::kAvx512) return avx512_kernels;
  if (set == InstructionSet::kAvx2) return avx2_kernels;
#endif
  static_cast<void>(set);
  return baseline_kernels;
}

}  // namespace remap
