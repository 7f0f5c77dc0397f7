#include "assets/document/text_edits.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "core/json.hpp"
#include "core/json_spans.hpp"
#include "core/plain_text.hpp"

namespace remap {
namespace {

// Returns the begin of an entry, or of a member with its key.
std::size_t start_of(SpanValue child) {
  const TextSpan key = child.key_span();
  return key.begin == key.end ? child.span().begin : key.begin;
}

}  // namespace

void TextEdits::replace(SpanValue value, std::string text) {
  if (value.raw() != text) replaced_[value.index()] = std::move(text);
}

void TextEdits::remove(SpanValue child) { changed_[child.parent().index()].removed.insert(child.index()); }

void TextEdits::remove_members(SpanValue object, std::string_view key) {
  for (const SpanValue& member : object.children())
    if (member.has_key(key)) remove(member);
}

void TextEdits::append_member(SpanValue object, std::string_view key, const std::string& text) {
  changed_[object.index()].appended.push_back(quoted_json(key) + colon_of(object) + text);
}

void TextEdits::append_entry(SpanValue list, const std::string& text) {
  changed_[list.index()].appended.push_back(text);
}

void TextEdits::set_member(SpanValue object, std::string_view key, const std::string& text) {
  if (const SpanValue member = object.find(key))
    replace(member, text);
  else
    append_member(object, key, text);
}

std::string_view TextEdits::space_before(SpanValue child) const {
  const std::string_view text = json_.text();
  const std::size_t end = start_of(child);
  std::size_t begin = end;
  while (text[begin - 1] != ',' && text[begin - 1] != '{' && text[begin - 1] != '[') --begin;
  return text.substr(begin, end - begin);
}

std::string TextEdits::colon_of(SpanValue object) const {
  const std::vector<SpanValue> members = object.children();
  if (members.empty()) return ":";
  const std::size_t begin = members.back().key_span().end, end = members.back().span().begin;
  return std::string(json_.text().substr(begin, end - begin));
}

// Removes each child with one separator. This is the separator after the child. If an earlier child stays, it
// is the separator before.
void TextEdits::add_splices(SpanValue container, const Changes& changes,
                            std::vector<TextSplice>& splices) const {
  const std::vector<SpanValue> children = container.children();
  const auto is_kept = [&](const SpanValue& child) { return !changes.removed.contains(child.index()); };
  const auto first_kept = std::ranges::find_if(children, is_kept);
  const std::string separator = "," + (children.empty() ? "" : std::string(space_before(children.back())));
  const std::string appended = joined(changes.appended, separator);
  if (first_kept == children.end()) {
    const std::size_t begin = children.empty() ? container.span().begin + 1 : start_of(children.front());
    const std::size_t end = children.empty() ? begin : children.back().span().end;
    splices.push_back({{begin, end}, appended});
    return;
  }
  if (first_kept != children.begin())
    splices.push_back({{start_of(children.front()), start_of(*first_kept)}, ""});
  for (auto child = first_kept + 1; child < children.end(); ++child)
    if (!is_kept(*child)) splices.push_back({{(child - 1)->span().end, child->span().end}, ""});
  const std::size_t end = children.back().span().end;
  if (!appended.empty()) splices.push_back({{end, end}, separator + appended});
}

std::vector<TextSplice> TextEdits::splices() const {
  std::vector<TextSplice> all;
  for (const auto& [index, text] : replaced_) all.push_back({json_.value(index).span(), text});
  for (const auto& [index, changes] : changed_) add_splices(json_.value(index), changes, all);
  sort_splices(all);
  return all;
}

std::vector<TextSpan> TextEdits::touched() const { return touched_by(splices()); }

std::string TextEdits::result() const { return spliced(json_.text(), splices()); }

void sort_splices(std::vector<TextSplice>& splices) {
  std::ranges::stable_sort(splices, [](const TextSplice& a, const TextSplice& b) {
    return a.span.begin != b.span.begin ? a.span.begin < b.span.begin : a.span.end < b.span.end;
  });
}

std::string spliced(std::string_view text, const std::vector<TextSplice>& splices) {
  std::string result;
  result.reserve(text.size() + 1024);
  std::size_t at = 0;
  for (const TextSplice& splice : splices) {
    if (splice.span.begin < at) throw numeric_error("two edits of a text overlap");
    result += text.substr(at, splice.span.begin - at);
    result += splice.text;
    at = splice.span.end;
  }
  result += text.substr(at);
  return result;
}

std::vector<TextSpan> touched_by(const std::vector<TextSplice>& splices) {
  std::vector<TextSpan> spans;
  for (const TextSplice& splice : splices)
    if (splice.span.begin != splice.span.end) spans.push_back(splice.span);
  return spans;
}

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
