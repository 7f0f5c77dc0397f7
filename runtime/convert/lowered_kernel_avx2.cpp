// The kernel of a lowered mapping for processors with AVX2; runtime/CMakeLists.txt has its flags.
#define REMAP_KERNEL convert_avx2
#include "convert/texel_kernel.inc"
