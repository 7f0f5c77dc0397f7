#include "assets/document/text_encoding.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "core/json.hpp"
#include "core/json_spans.hpp"

namespace remap {
namespace {

constexpr std::uint64_t kBlock = std::uint64_t{1} << 20;  // even, so that no unit is cut
constexpr std::uint32_t kFirstHalves = 0xd800, kSecondHalves = 0xdc00, kAfterHalves = 0xe000,
                        kLongCharacters = 0x10000;

std::uint32_t byte_at(std::string_view bytes, std::size_t at) { return static_cast<std::uint8_t>(bytes[at]); }

void append_unit(std::uint32_t unit, TextEncoding encoding, std::string& bytes) {
  const char low = static_cast<char>(unit & 0xff), high = static_cast<char>(unit >> 8);
  bytes += encoding == TextEncoding::kUtf16Big ? high : low;
  bytes += encoding == TextEncoding::kUtf16Big ? low : high;
}

}  // namespace

// Detects UTF-16 without a mark, because every other byte of an English text is then 0.
TextEncoding encoding_of(const ByteSource& source) {
  constexpr std::size_t kMark = 2, kTwoLetters = 4;
  const std::string start =
      source.read(0, static_cast<std::size_t>(std::min<std::uint64_t>(source.size(), kTwoLetters)));
  const auto is_zero = [&](std::size_t at) { return start[at] == '\0'; };
  if (start.substr(0, kMark) == "\xff\xfe") return TextEncoding::kUtf16Little;
  if (start.substr(0, kMark) == "\xfe\xff") return TextEncoding::kUtf16Big;
  const bool alternates = start.size() == kTwoLetters && is_zero(0) != is_zero(1) &&
                          is_zero(0) == is_zero(2) && is_zero(1) == is_zero(3);
  if (!alternates) return TextEncoding::kBytes;
  return is_zero(0) ? TextEncoding::kUtf16Big : TextEncoding::kUtf16Little;
}

std::string TextReader::next() {
  const std::uint64_t begin = at_;
  at_ += std::min(kBlock, source_.size() - at_);
  std::string bytes = source_.read(begin, static_cast<std::size_t>(at_ - begin));
  if (encoding_ == TextEncoding::kBytes) return bytes;
  const std::size_t high = encoding_ == TextEncoding::kUtf16Big ? 0 : 1;
  std::string text;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2)
    add_unit(byte_at(bytes, i + high) << 8 | byte_at(bytes, i + 1 - high), begin + i, text);
  if (bytes.size() % 2 != 0) refuse(at_ - 1);
  if (at_ == source_.size() && first_half_ != 0) refuse(at_ - 2);
  return text;
}

void TextReader::add_unit(std::uint32_t unit, std::uint64_t begin, std::string& text) {
  const bool is_second = unit >= kSecondHalves && unit < kAfterHalves;
  if (is_second != (first_half_ != 0)) refuse(is_second ? begin : begin - 2);
  if (is_second) {
    text += utf8_of(kLongCharacters + ((first_half_ - kFirstHalves) << 10) + (unit - kSecondHalves));
    first_half_ = 0;
  } else if (unit >= kFirstHalves && unit < kSecondHalves) {
    first_half_ = unit;
  } else if (unit < 0x80) {
    text += static_cast<char>(unit);
  } else {
    text += utf8_of(unit);
  }
}

void TextReader::refuse(std::uint64_t begin) const {
  throw input_error(context_ + ": has an incomplete UTF-16 character at byte " + std::to_string(begin) +
                    " (save it as UTF-8)");
}

std::string utf8_text(const ByteSource& source, const std::string& context) {
  TextReader reader(source, context);
  std::string text;
  for (std::string block = reader.next(); !block.empty(); block = reader.next()) text += block;
  return text;
}

std::string encoded(const std::string& text, TextEncoding encoding, const std::string& context) {
  if (encoding == TextEncoding::kBytes) return text;
  if (!is_utf8(text))
    throw input_error(context + ": refers to a file whose name UTF-16 cannot store (rename the file)");
  std::string bytes;
  bytes.reserve(2 * text.size());
  for (std::size_t at = 0; at < text.size();) {
    const std::uint32_t first = byte_at(text, at);
    const std::size_t length = first < 0x80 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    std::uint32_t code = length == 1 ? first : first & (0x7fu >> length);
    for (std::size_t i = 1; i < length; ++i) code = code << 6 | (byte_at(text, at + i) & 0x3f);
    at += length;
    if (code < kLongCharacters) {
      append_unit(code, encoding, bytes);
      continue;
    }
    append_unit(kFirstHalves + ((code - kLongCharacters) >> 10), encoding, bytes);
    append_unit(kSecondHalves + ((code - kLongCharacters) & 0x3ff), encoding, bytes);
  }
  return bytes;
}

}  // namespace remap
