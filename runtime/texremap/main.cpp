// texremap: converts texture maps from the parameters of one BRDF model to those of another.
#include "command_line/interruption.hpp"
#include "texremap/commands.hpp"

int main(int argc, char** argv) {
  remap::watch_interruptions();
  return remap::run_texremap(argc, argv);
}
