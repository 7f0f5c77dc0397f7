// This file declares the only exception type of the project. Libraries throw it. Only the main functions
// print it and exit.
#pragma once

#include <stdexcept>
#include <string>

namespace remap {

// An ErrorKind lets a caller react without reading the message.
enum class ErrorKind {
  kUsage,        // the request names something that does not exist, or its parts contradict each other
  kInput,        // a given file or value cannot be used
  kOutput,       // a result cannot be written
  kNumeric,      // a computation did not reach a reliable answer
  kInterrupted,  // the user or the system asked the program to stop
};

// An Error has a message of the form `place: what was found; what was expected`, in one line for people.
class Error : public std::runtime_error {
 public:
  // `system_code` is the errno of the system call that failed, or 0 if no such call failed.
  Error(ErrorKind kind, const std::string& message, int system_code = 0)
      : std::runtime_error(message), kind_(kind), system_code_(system_code) {}
  ErrorKind kind() const noexcept { return kind_; }
  int system_code() const noexcept { return system_code_; }

 private:
  ErrorKind kind_;
  int system_code_;
};

}  // namespace remap
