// The one exception type of the project. Libraries throw it; only the two main functions print it and exit.
#pragma once

#include <stdexcept>
#include <string>

namespace remap {

// What went wrong, so that a caller can react without reading the message.
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
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const noexcept { return kind_; }

 private:
  ErrorKind kind_;
};

// Exit code of both tools: 0 done, 1 failed, 2 wrong usage.
inline int exit_code(ErrorKind kind) noexcept { return kind == ErrorKind::kUsage ? 2 : 1; }

}  // namespace remap
