// This file splits file names at separators.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/json_spans.hpp"

namespace remap {

inline bool is_separator(char c) noexcept { return c == '_' || c == '-' || c == '.' || c == ' '; }
inline bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }
inline bool is_lower(char c) noexcept { return c >= 'a' && c <= 'z'; }
inline bool is_upper(char c) noexcept { return c >= 'A' && c <= 'Z'; }

// Converts ASCII letters to lower case and keeps all other bytes. The result does not depend on the locale,
// and UTF-8 stays valid.
inline char lower(char c) noexcept { return is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c; }
inline std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = lower(c);
  return result;
}

// A NamePiece is the part of a name between two separators. A piece is never empty.
using NamePiece = TextSpan;

inline std::vector<NamePiece> name_pieces(std::string_view name) {
  std::vector<NamePiece> pieces;
  for (std::size_t i = 0; i < name.size();) {
    if (is_separator(name[i])) {
      ++i;
      continue;
    }
    const std::size_t begin = i;
    while (i < name.size() && !is_separator(name[i])) ++i;
    pieces.push_back({begin, i});
  }
  return pieces;
}

}  // namespace remap
