// This file compiles texremap into its tests (support/loaded_program.hpp), with its main function under
// another name.
#define main texremap_main
#include "texremap/commands/main.cpp"
#undef main

#include "support/loaded_program.hpp"

namespace {
[[maybe_unused]] const bool is_loaded = remap::loads_program(REMAP_TEXREMAP, texremap_main);
}
