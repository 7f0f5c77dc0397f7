// This file compiles the kernels for processors with AVX2; runtime/CMakeLists.txt has its flags.
#define REMAP_KERNELS avx2_kernels
#include "stages/kernels.inc"
