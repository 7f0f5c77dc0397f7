// This file returns errors as text.
#pragma once

#include <optional>
#include <string>

#include <catch2/catch.hpp>

#include "remap/error.hpp"

namespace remap {

// Returns the message of the Error that `work` throws, or an empty text if it throws none. An error of
// another kind than `kind` fails the test.
template <typename Work>
std::string error_of(const Work& work, std::optional<ErrorKind> kind = std::nullopt) {
  try {
    work();
  } catch (const Error& error) {
    if (kind) CHECK(error.kind() == *kind);
    return error.what();
  }
  return "";
}

}  // namespace remap
