#include "stages/kernels.hpp"

namespace remap {

extern const Kernels baseline_kernels;
#if REMAP_HAS_X86_SETS
extern const Kernels avx2_kernels, avx512_kernels;
#endif

const Kernels& kernels(InstructionSet set) {
#if REMAP_HAS_X86_SETS
  if (set == InstructionSet::kAvx512) return avx512_kernels;
  if (set == InstructionSet::kAvx2) return avx2_kernels;
#endif
  static_cast<void>(set);
  return baseline_kernels;
}

}  // namespace remap
