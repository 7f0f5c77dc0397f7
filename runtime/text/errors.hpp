// The errors of this project by their kind, to be thrown: `throw input_error("place: what is wrong
// (remedy)")`.
#pragma once

#include <string>

#include "remap/error.hpp"

namespace remapc {

inline remap::Error usage_error(const std::string& message) { return {remap::ErrorKind::kUsage, message}; }
inline remap::Error input_error(const std::string& message) { return {remap::ErrorKind::kInput, message}; }
inline remap::Error output_error(const std::string& message) { return {remap::ErrorKind::kOutput, message}; }
inline remap::Error numeric_error(const std::string& message) {
  return {remap::ErrorKind::kNumeric, message};
}

}  // namespace remapc
