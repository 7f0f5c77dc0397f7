// texremap: converts texture maps from the parameters of one BRDF model to those of another.
#include "command_line/interruption.hpp"
#include "core/system.hpp"
#include "texremap/commands/commands.hpp"
#include "texremap/run/job_processes.hpp"

int main(int argc, char** argv) {
  // A run holds the files of the sets that its threads convert: as many as the system allows, not the shell.
  remap::raise_limit_of_open_files();
  remap::watch_interruptions();
  remap::use_job_processes();
  return remap::run_texremap(argc, argv);
}
