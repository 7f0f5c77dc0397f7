// This file makes errors of each kind, and names the kinds for hosts in other languages. They are thrown as
// `throw input_error("place: what is wrong (fix)")`.
#pragma once

#include <cerrno>
#include <cstring>
#include <string>

#include "remap/error.hpp"
#include "remap/model.hpp"

namespace remap {

inline Error usage_error(const std::string& message) { return {ErrorKind::kUsage, message}; }
inline Error input_error(const std::string& message) { return {ErrorKind::kInput, message}; }
inline Error output_error(const std::string& message) { return {ErrorKind::kOutput, message}; }
inline Error numeric_error(const std::string& message) { return {ErrorKind::kNumeric, message}; }
// Returns the error of a system call that failed with errno `code`. Its text is `message`, followed by the
// text of the system.
inline Error system_error(ErrorKind kind, const std::string& message, int code) {
  return {kind, message + ": " + std::strerror(code), code};
}

// Returns true if the same call may work a moment later, for example because a file server was restarted.
inline bool is_transient(int system_code) noexcept {
#ifdef ESTALE
  if (system_code == ESTALE) return true;
#endif
  return system_code == EIO;
}

// Returns true if the run may work when it is repeated: the storage was full or did not answer, or the run
// was stopped (EINTR).
inline bool is_retryable(int system_code) noexcept {
#ifdef EDQUOT
  if (system_code == EDQUOT) return true;
#endif
  return system_code == ENOSPC || system_code == EINTR || is_transient(system_code);
}

// Returns the exit code of both programs: 0 done, 1 failed, 2 wrong usage, 75 failed but may work when
// repeated (EX_TEMPFAIL of sysexits.h, which schedulers know).
inline int exit_code(const Error& error) noexcept {
  if (error.kind() == ErrorKind::kUsage) return 2;
  return is_retryable(error.system_code()) ? 75 : 1;
}

inline constexpr NamedValues<ErrorKind, 5> kErrorKinds = {{{ErrorKind::kUsage, "usage"},
                                                           {ErrorKind::kInput, "input"},
                                                           {ErrorKind::kOutput, "output"},
                                                           {ErrorKind::kNumeric, "numeric"},
                                                           {ErrorKind::kInterrupted, "interrupted"}}};

}  // namespace remap
