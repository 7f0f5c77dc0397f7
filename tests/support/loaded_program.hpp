// This file runs the program under test as a part of the test program. Each of its processes is a copy of one
// process, which has loaded all libraries but has not run the program yet. Loading takes a quarter of a
// second, and more under sanitizers. Other tests (scripts, farms, packages) start the file of the program.
#pragma once

#include <string>
#include <sys/resource.h>
#include <sys/types.h>
#include <vector>

namespace remap {

// Loads the program before the first case. `main` is its main function, `path` the path of its file. Call it
// before main(), for one program. Returns true.
bool loads_program(const char* path, int (*main)(int argc, char** argv));

// A ProcessStart is the start state of a process. `errors` and `output` are files; without a limit
// `file_bytes` is RLIM_INFINITY.
struct ProcessStart {
  std::vector<std::string> arguments;
  std::string folder, output, errors;
  rlim_t file_bytes = RLIM_INFINITY;
};
// Applies everything except the arguments to the process. Safe between fork and exec.
void enter(const ProcessStart& start) noexcept;

// Returns true if processes of the program at `path` are copies of a loaded one.
bool is_loaded(const std::string& path);

// Starts a process from any thread. Both functions throw std::runtime_error if the loaded process is gone.
pid_t start_loaded(const ProcessStart& start);
// Returns true if the process has ended, with its status and usage as from wait4().
bool has_ended(pid_t process, int& status, rusage& usage);

}  // namespace remap
