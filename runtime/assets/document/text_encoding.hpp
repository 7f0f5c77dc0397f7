// This file has the encodings of texts: single bytes (among them UTF-8), or UTF-16, as Windows tools write
// it. Texts are read and edited as UTF-8.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "assets/document/asset.hpp"

namespace remap {

enum class TextEncoding { kBytes, kUtf16Little, kUtf16Big };

// By the byte order mark, or by the zeros of the first letters.
TextEncoding encoding_of(const ByteSource& source);

// Reads a text in blocks.
class TextReader {
 public:
  // Both must outlive it.
  TextReader(const ByteSource& source, const std::string& context)
      : source_(source), context_(context), encoding_(encoding_of(source)) {}

  // The next block, with a byte order mark as UTF-8 has it; empty at the end. Throws kInput, beginning with
  // `context`, for UTF-16 with half a character.
  std::string next();

 private:
  void add_unit(std::uint32_t unit, std::uint64_t begin, std::string& text);
  [[noreturn]] void refuse(std::uint64_t begin) const;

  const ByteSource& source_;
  const std::string& context_;
  TextEncoding encoding_;
  std::uint64_t at_ = 0;
  std::uint32_t first_half_ = 0;  // of a character, the surrogate before this place; 0 for none
};

// The whole text. As TextReader::next().
std::string utf8_text(const ByteSource& source, const std::string& context);

// A text as it is written: utf8_text() of the bytes is the text again. Throws kInput, beginning with
// `context`, where UTF-16 is asked of what is not UTF-8.
std::string encoded(const std::string& text, TextEncoding encoding, const std::string& context);

}  // namespace remap
