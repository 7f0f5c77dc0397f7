// This is texremap. It converts texture maps from one BRDF model's parameters to another's.
#include "command_line/progress.hpp"
#include "core/system.hpp"
#include "texremap/commands/commands.hpp"
#include "texremap/run/job_processes.hpp"

int main(int argc, char** argv) {
  // Raise the limit to what the system allows, because a run keeps the files of all converting threads open.
  remap::raise_limit_of_open_files();
  remap::watch_interruptions();
  remap::use_job_processes();
  return remap::run_texremap(argc, argv);
}
