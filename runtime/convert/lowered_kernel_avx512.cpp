// The kernel of a lowered mapping for processors with AVX-512; runtime/CMakeLists.txt has its flags.
#define REMAP_KERNEL convert_avx512
#include "convert/texel_kernel.inc"
