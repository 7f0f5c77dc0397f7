// This file runs a program like a shell and keeps its output.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <sys/resource.h>
#include <sys/types.h>
#include <vector>

#include <catch2/catch.hpp>

#include "support/temporary_folder.hpp"

namespace remap {

struct ProcessResult {
  int exit_code = -1;  // -1 if a signal ended the process
  int signal = 0;      // the signal that ended it
  std::string output;  // standard output
  std::string errors;  // standard error
  long peak_kilobytes = 0;

  // Returns the last line of standard error, because some libraries print before the program does.
  std::string last_error() const;
};

// A Words holds the words of a command: a list of words, or a text with spaces between them and without
// quotes.
struct Words : std::vector<std::string> {
  using vector::vector;
  Words(const std::vector<std::string>& words) : vector(words) {}
  Words(const std::string& command);
  Words(const char* command) : Words(std::string(command)) {}
  Words& operator+=(const Words& more);
  friend Words operator+(Words words, const Words& more) { return words += more; }
};

struct ProcessLimits {
  std::filesystem::path folder = {};      // the working folder, if it differs from the test's
  std::optional<rlim_t> file_bytes = {};  // limit as by `ulimit -f`: writing more fails
  bool keeps_permissions = false;  // if true, permissions of files apply to it, even if the test runs as root
};

// A Process runs at the same time as the test. The destructor kills it if nobody has waited for it.
class Process {
 public:
  // `arguments` begins with the path of the program. Throws std::runtime_error if it cannot be started.
  explicit Process(const Words& arguments, const ProcessLimits& limits = {});
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void send(int signal) const;
  bool is_running();
  // Returns true if the program has a handler of `signal`. On a busy machine it takes long to start.
  bool catches(int signal) const;
  ProcessResult wait();

 private:
  TemporaryFolder folder_;
  bool is_copy_;  // true for a copy of a loaded program (support/loaded_program.hpp)
  pid_t pid_ = -1;
  std::optional<ProcessResult> result_;
  bool collect_if_ended();
  void collect(int status, long peak_kilobytes);
};

// Starts a process and waits for it.
ProcessResult run(const Words& arguments, const ProcessLimits& limits = {});

// A CommandFolder is a separate folder in which programs run.
class CommandFolder {
 public:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string content(const std::string& name) const;  // content of a file
  Process start(const Words& words, ProcessLimits limits = {}) const;
  ProcessResult run(const Words& words, const ProcessLimits& limits = {}) const {
    return start(words, limits).wait();
  }

 private:
  TemporaryFolder folder_;
};

// Returns the result of a program that must have ended with exit code 0. Otherwise the test ends with the
// program's output.
inline ProcessResult require_success(ProcessResult result) {
  INFO(result.errors);
  REQUIRE(result.exit_code == 0);
  return result;
}

// Returns how often `text` holds `part`.
inline std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace remap
