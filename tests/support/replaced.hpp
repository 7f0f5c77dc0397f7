// This file makes files that have one wrong place.
#pragma once

#include <string>

#include <catch2/catch.hpp>

namespace remap {

// Returns `text` with `other` instead of the first `part`, which must occur.
inline std::string replaced(std::string text, const std::string& part, const std::string& other) {
  const std::size_t start = text.find(part);
  REQUIRE(start != std::string::npos);
  return text.replace(start, part.size(), other);
}

}  // namespace remap
