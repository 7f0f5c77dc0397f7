// The kernels for every processor; runtime/CMakeLists.txt has their flags.
#define REMAP_KERNELS baseline_kernels
#include "stages/kernels.inc"
