// The errors of this project by their kind, to be thrown: `throw input_error("place: what is wrong
// (remedy)")`.
#pragma once

#include <string>

#include "remap/error.hpp"

namespace remap {

inline Error usage_error(const std::string& message) { return {ErrorKind::kUsage, message}; }
inline Error input_error(const std::string& message) { return {ErrorKind::kInput, message}; }
inline Error output_error(const std::string& message) { return {ErrorKind::kOutput, message}; }
inline Error numeric_error(const std::string& message) { return {ErrorKind::kNumeric, message}; }

}  // namespace remap
