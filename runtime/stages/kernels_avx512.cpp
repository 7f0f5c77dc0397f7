// This file compiles the kernels for processors with AVX-512; runtime/CMakeLists.txt has its flags.
#define REMAP_KERNELS avx512_kernels
#include "stages/kernels.inc"
