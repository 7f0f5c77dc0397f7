// texremap as a part of its tests (support/loaded_program.hpp): its main function under another name.
#define main texremap_main
#include "texremap/main.cpp"
#undef main

#include "support/loaded_program.hpp"

const remap::LoadedProgram remap::kLoadedProgram{REMAP_TEXREMAP, texremap_main};
