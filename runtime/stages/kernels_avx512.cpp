// The kernels for processors with AVX-512; runtime/CMakeLists.txt has their flags.
#define REMAP_KERNELS avx512_kernels
#include "stages/kernels.inc"
