// The kernel of a lowered mapping for every processor; runtime/CMakeLists.txt has its flags.
#define REMAP_KERNEL convert_baseline
#include "convert/texel_kernel.inc"
