// This file is the program texremap for node.
#include "texremap/commands/commands.hpp"

int main(int argc, char** argv) { return remap::run_texremap(argc, argv); }
