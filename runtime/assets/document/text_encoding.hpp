// This file handles the encodings of texts: single bytes (such as UTF-8), or UTF-16, as Windows tools write
// it. Texts are read and edited as UTF-8.
#pragma once

#include <cstdint>
#include <string>

#include "assets/document/asset.hpp"

namespace remap {

enum class TextEncoding { kBytes, kUtf16Little, kUtf16Big };

// Detects the encoding by the byte order mark, or by the zeros of the first letters.
TextEncoding encoding_of(const ByteSource& source);

class TextReader {
 public:
  // Both arguments must outlive this object.
  TextReader(const ByteSource& source, const std::string& context)
      : source_(source), context_(context), encoding_(encoding_of(source)) {}

  // Returns the next block as UTF-8, including a byte order mark. Returns an empty text at the end. Throws
  // kInput, beginning with `context`, for UTF-16 with an incomplete character.
  std::string next();

 private:
  void add_unit(std::uint32_t unit, std::uint64_t begin, std::string& text);
  [[noreturn]] void refuse(std::uint64_t begin) const;

  const ByteSource& source_;
  const std::string& context_;
  TextEncoding encoding_;
  std::uint64_t at_ = 0;
  std::uint32_t first_half_ = 0;  // surrogate at the end of the last block, or 0
};

// Returns the whole text. Throws like TextReader::next().
std::string utf8_text(const ByteSource& source, const std::string& context);

// Encodes a text so that utf8_text() of the bytes returns it again. Throws kInput, beginning with `context`,
// if UTF-16 is requested for a text that is not UTF-8.
std::string encoded(const std::string& text, TextEncoding encoding, const std::string& context);

}  // namespace remap
