// texremap: converts texture maps from the parameters of one BRDF model to those of another.
#include <sys/resource.h>

#include "command_line/interruption.hpp"
#include "texremap/commands.hpp"

namespace {

// A run holds the files of the sets that its threads convert: as many as the system allows, not the shell.
void raise_limit_of_open_files() {
  ::rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

}  // namespace

int main(int argc, char** argv) {
  raise_limit_of_open_files();
  remap::watch_interruptions();
  return remap::run_texremap(argc, argv);
}
