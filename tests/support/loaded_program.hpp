// The program under test as a part of the test program. Its processes are copies of one that has loaded all
// libraries and run nothing, which takes a quarter of a second, and under sanitizers more. Those who run the
// program in other ways (scripts, farms, packages) start its file.
#pragma once

#include <string>
#include <sys/resource.h>
#include <sys/types.h>
#include <vector>

namespace remap {

// Loads the program before the first case: `main` is its main function, `path` that of its file. To be called
// before main(), for one program. Returns true.
bool loads_program(const char* path, int (*main)(int argc, char** argv));

// What a process starts with. `errors` and `output` are files; without a limit `file_bytes` is RLIM_INFINITY.
struct ProcessStart {
  std::vector<std::string> arguments;
  std::string folder, output, errors;
  rlim_t file_bytes = RLIM_INFINITY;
};
// Gives the process all of that but its arguments. Safe between fork and exec.
void enter(const ProcessStart& start) noexcept;

// Whether processes of the program at `path` are copies of a loaded one.
bool is_loaded(const std::string& path);

// Throw std::runtime_error where the loaded process is gone. For any thread.
pid_t start_loaded(const ProcessStart& start);
// Whether the process has ended; then its status and usage as by wait4().
bool has_ended(pid_t process, int& status, rusage& usage);

}  // namespace remap
