// The one exception type of the project. Libraries throw it; only the two main functions print it and exit.
#pragma once

#include <stdexcept>
#include <string>

namespace remap {

// The kind of an error, so that a caller can react without reading the message.
enum class ErrorKind {
  kUsage,        // the caller asked for something that does not exist or does not fit together
  kInput,        // a file or value that was given cannot be used
  kOutput,       // a result cannot be written
  kNumeric,      // a computation did not reach an answer that can be trusted
  kInterrupted,  // the user or the system asked the program to stop
};

// Message of the form `place: what was found; what was expected`, one line, ready to be shown to a person.
class Error : public std::runtime_error {
 public:
  // `system_code`: the errno of the call that failed; 0 where none did.
  Error(ErrorKind kind, const std::string& message, int system_code = 0)
      : std::runtime_error(message), kind_(kind), system_code_(system_code) {}
  ErrorKind kind() const noexcept { return kind_; }
  int system_code() const noexcept { return system_code_; }

 private:
  ErrorKind kind_;
  int system_code_;
};

}  // namespace remap
