// The errors of this project by their kind, to be thrown: `throw input_error("place: what is wrong
// (remedy)")`.
#pragma once

#include <cerrno>
#include <cstring>
#include <string>

#include "remap/error.hpp"

namespace remap {

inline Error usage_error(const std::string& message) { return {ErrorKind::kUsage, message}; }
inline Error input_error(const std::string& message) { return {ErrorKind::kInput, message}; }
inline Error output_error(const std::string& message) { return {ErrorKind::kOutput, message}; }
inline Error numeric_error(const std::string& message) { return {ErrorKind::kNumeric, message}; }
// A call of the system failed with errno `code`, whose words follow `message`.
inline Error system_error(ErrorKind kind, const std::string& message, int code) {
  return {kind, message + ": " + std::strerror(code), code};
}

// True if the same call may work a moment later, for example because a file server is busy or was restarted.
inline bool is_transient(int system_code) noexcept {
#ifdef ESTALE
  if (system_code == ESTALE) return true;
#endif
  return system_code == EIO;
}

// Whether the run may work when it is tried again: the storage was full or did not answer, or the run was
// stopped (EINTR).
inline bool is_retryable(int system_code) noexcept {
#ifdef EDQUOT
  if (system_code == EDQUOT) return true;
#endif
  return system_code == ENOSPC || system_code == EINTR || is_transient(system_code);
}

// Exit code of both programs: 0 done, 1 failed, 2 wrong usage, 75 failed and may work when tried again
// (EX_TEMPFAIL of sysexits.h, which schedulers know).
inline int exit_code(const Error& error) noexcept {
  if (error.kind() == ErrorKind::kUsage) return 2;
  return is_retryable(error.system_code()) ? 75 : 1;
}

}  // namespace remap
