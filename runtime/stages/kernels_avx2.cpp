// The kernels for processors with AVX2; runtime/CMakeLists.txt has their flags.
#define REMAP_KERNELS avx2_kernels
#include "stages/kernels.inc"
