// This file compiles the kernels for every processor; runtime/CMakeLists.txt has its flags.
#define REMAP_KERNELS baseline_kernels
#include "stages/kernels.inc"
