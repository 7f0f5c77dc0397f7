#include "core/json_spans.hpp"

#include <algorithm>
#include <charconv>

#include "core/errors.hpp"
#include "core/json.hpp"
#include "core/number_text.hpp"

namespace remap {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::uint8_t byte_at(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<std::uint8_t>(text[at]) : 0;
}

// Returns the length of the multibyte character at `at`, or 0 if it is not UTF-8 (Unicode, table 3-7).
std::size_t utf8_length(std::string_view text, std::size_t at) {
  const std::uint8_t first = byte_at(text, at), second = byte_at(text, at + 1);
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  const std::uint8_t least = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
  const std::uint8_t most = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
  if (first < 0xc2 || first > 0xf4 || second < least || second > most) return 0;
  for (std::size_t i = 2; i < length; ++i)
    if (byte_at(text, at + i) < 0x80 || byte_at(text, at + i) > 0xbf) return 0;
  return length;
}

// Returns the four hexadecimal digits at `at`, or nothing if there are fewer.
std::optional<std::uint32_t> hex_at(std::string_view text, std::size_t at) {
  std::uint32_t code = 0;
  if (at + 4 > text.size()) return std::nullopt;
  const char* const begin = text.data() + at;
  const auto [end, failure] = std::from_chars(begin, begin + 4, code, 16);
  if (failure != std::errc() || end != begin + 4) return std::nullopt;
  return code;
}

bool is_high_surrogate(std::uint32_t code) { return code >= 0xd800 && code <= 0xdbff; }
bool is_low_surrogate(std::uint32_t code) { return code >= 0xdc00 && code <= 0xdfff; }

// An EscapedCode holds the code point of an escape \uXXXX, and the place after it. The code is unset if half
// of a surrogate pair occurs without the other half.
struct EscapedCode {
  std::uint32_t code = 0;
  std::size_t end = 0;
};
std::optional<EscapedCode> escaped_code(std::string_view text, std::size_t at) {
  const auto first = hex_at(text, at + 2);
  if (!first || is_low_surrogate(*first)) return std::nullopt;
  if (!is_high_surrogate(*first)) return EscapedCode{*first, at + 6};
  if (text.substr(at + 6, 2) != "\\u") return std::nullopt;
  const auto second = hex_at(text, at + 8);
  if (!second || !is_low_surrogate(*second)) return std::nullopt;
  return EscapedCode{0x10000 + ((*first - 0xd800) << 10) + (*second - 0xdc00), at + 12};
}

// Returns the character that a short escape means, or 0 if there is none.
char short_escape(char c) {
  constexpr std::string_view kLetters = "\"\\/bfnrt", kMeant = "\"\\/\b\f\n\r\t";
  const std::size_t at = kLetters.find(c);
  return at == std::string_view::npos ? '\0' : kMeant[at];
}

// Returns the text between the quotes of a scanned string.
std::string unescaped(std::string_view raw) {
  std::string result;
  for (std::size_t i = 1; i + 1 < raw.size();) {
    if (raw[i] != '\\') {
      result += raw[i++];
    } else if (raw[i + 1] == 'u') {
      const EscapedCode escaped = escaped_code(raw, i).value_or(EscapedCode{0xfffd, i + 6});
      result += utf8_of(escaped.code);
      i = escaped.end;
    } else {
      result += short_escape(raw[i + 1]);
      i += 2;
    }
  }
  return result;
}

}  // namespace

// A SpanScanner scans a text once, value by value. Each level of nesting is one call.
class SpanScanner {
 public:
  SpanScanner(SpannedJson& json, const std::string& context)
      : json_(json), text_(json.text_), context_(context), at_(text_.starts_with(kByteOrderMark) ? 3 : 0) {}

  void scan() {
    skip_space();
    scan_value(0, {}, 0);
    skip_space();
    if (at_ != text_.size()) fail("something follows the value");
  }

 private:
  using Node = SpannedJson::Node;

  [[noreturn]] void fail(const std::string& reason) const {
    const std::string_view before = text_.substr(0, std::min(at_, text_.size()));
    const std::size_t line = static_cast<std::size_t>(std::ranges::count(before, '\n')) + 1;
    const std::size_t start = before.rfind('\n');
    const std::size_t column = before.size() - (start == std::string_view::npos ? 0 : start + 1) + 1;
    throw input_error(context_ + ": invalid JSON at line " + std::to_string(line) + ", column " +
                      std::to_string(column) + ": " + reason);
  }

  char next() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void skip_space() {
    while (at_ < text_.size() &&
           (text_[at_] == ' ' || text_[at_] == '\n' || text_[at_] == '\r' || text_[at_] == '\t'))
      ++at_;
  }
  void take(char c) {
    if (next() != c)
      fail(at_ >= text_.size() ? "the text ends too early" : std::string("expected '") + c + "'");
    ++at_;
  }

  // Returns the index of the node.
  std::size_t scan_value(std::size_t parent, TextSpan key, std::size_t depth) {
    const std::size_t index = json_.nodes_.size();
    if (index == kMostSpannedValues)
      fail("more than " + std::to_string(kMostSpannedValues) + " values (split the file)");
    Node node;
    node.parent = static_cast<std::uint32_t>(parent);
    node.key_begin = static_cast<std::uint32_t>(key.begin);
    node.key_end = static_cast<std::uint32_t>(key.end);
    node.begin = static_cast<std::uint32_t>(at_);
    json_.nodes_.push_back(node);
    const SpanKind kind = scan_content(index, depth);
    json_.nodes_[index].kind = kind;
    json_.nodes_[index].end = static_cast<std::uint32_t>(at_);
    return index;
  }

  SpanKind scan_content(std::size_t index, std::size_t depth) {
    switch (next()) {
      case '{':
        scan_children(index, depth, '}');
        return SpanKind::kObject;
      case '[':
        scan_children(index, depth, ']');
        return SpanKind::kList;
      case '"':
        scan_text();
        return SpanKind::kText;
      case 't':
        scan_word("true");
        return SpanKind::kBoolean;
      case 'f':
        scan_word("false");
        return SpanKind::kBoolean;
      case 'n':
        scan_word("null");
        return SpanKind::kNull;
      default:
        scan_number();
        return SpanKind::kNumber;
    }
  }

  void scan_children(std::size_t index, std::size_t depth, char end) {
    if (depth == kDeepestJson) fail("nested deeper than " + std::to_string(kDeepestJson) + " levels");
    ++at_;
    skip_space();
    if (next() == end) {
      ++at_;
      return;
    }
    for (std::size_t previous = 0;;) {
      const std::size_t child = scan_child(index, depth + 1, end == '}');
      if (previous != 0) json_.nodes_[previous].next = static_cast<std::uint32_t>(child);
      previous = child;
      ++json_.nodes_[index].count;
      skip_space();
      if (next() != ',') break;
      ++at_;
      skip_space();
    }
    take(end);
  }

  std::size_t scan_child(std::size_t parent, std::size_t depth, bool has_key) {
    if (!has_key) return scan_value(parent, {}, depth);
    const std::size_t begin = at_;
    if (next() != '"') fail(at_ >= text_.size() ? "the text ends too early" : "expected a key in quotes");
    scan_text();
    const std::size_t end = at_;
    skip_space();
    take(':');
    skip_space();
    return scan_value(parent, {begin, end}, depth);
  }

  void scan_word(std::string_view word) {
    if (text_.substr(at_, word.size()) != word) fail("expected a value");
    at_ += word.size();
  }

  void scan_digits() {
    if (!is_digit(next())) fail(at_ >= text_.size() ? "the text ends too early" : "expected a value");
    while (is_digit(next())) ++at_;
  }

  void scan_number() {
    if (next() == '-') ++at_;
    if (next() == '0')
      ++at_;
    else
      scan_digits();
    if (next() == '.') {
      ++at_;
      scan_digits();
    }
    if (next() != 'e' && next() != 'E') return;
    ++at_;
    if (next() == '+' || next() == '-') ++at_;
    scan_digits();
  }

  void scan_text() {
    ++at_;
    while (next() != '"' || at_ >= text_.size()) {
      if (at_ >= text_.size()) fail("the text ends too early");
      const auto c = static_cast<std::uint8_t>(text_[at_]);
      if (c < 0x20) fail("a control character in a text");
      if (c == '\\')
        scan_escape();
      else if (c < 0x80)
        ++at_;
      else if (const std::size_t length = utf8_length(text_, at_); length != 0)
        at_ += length;
      else
        fail("a text that is not UTF-8");
    }
    ++at_;
  }

  void scan_escape() {
    const char letter = at_ + 1 < text_.size() ? text_[at_ + 1] : '\0';
    if (letter == 'u') {
      const auto escaped = escaped_code(text_, at_);
      if (!escaped) fail("an escape that is not a character");
      at_ = escaped->end;
    } else {
      if (short_escape(letter) == '\0') fail("an unknown escape");
      at_ += 2;
    }
  }

  SpannedJson& json_;
  std::string_view text_;
  const std::string& context_;
  std::size_t at_;
};

SpannedJson::SpannedJson(std::string_view text, const std::string& context) : text_(text) {
  if (text.size() > kLongestSpannedText)
    throw input_error(context + ": has " + std::to_string(text.size() >> 20) + " MB of JSON; at most " +
                      std::to_string(kLongestSpannedText >> 20) +
                      " MB can be read (store buffers and images in separate files)");
  SpanScanner(*this, context).scan();
}

SpanValue SpannedJson::root() const noexcept { return value(0); }
SpanValue SpannedJson::value(std::size_t index) const noexcept { return {this, index}; }

std::string SpanValue::key() const {
  const TextSpan span = key_span();
  return unescaped(json_->text_.substr(span.begin, span.end - span.begin));
}

bool SpanValue::has_key(std::string_view key) const {
  const TextSpan span = key_span();
  if (span.end == span.begin) return false;
  const std::string_view inner = json_->text_.substr(span.begin + 1, span.end - span.begin - 2);
  return inner.find('\\') == std::string_view::npos ? inner == key : this->key() == key;
}

SpanValue SpanValue::parent() const noexcept {
  return json_ == nullptr || index_ == 0 ? SpanValue() : SpanValue(json_, node().parent);
}

std::string_view SpanValue::raw() const noexcept {
  return json_->text_.substr(node().begin, node().end - node().begin);
}

std::optional<std::string> SpanValue::text() const {
  return is(SpanKind::kText) ? std::make_optional(unescaped(raw())) : std::nullopt;
}

std::optional<double> SpanValue::number() const {
  return is(SpanKind::kNumber) ? parse_number(raw()) : std::nullopt;
}

// Accepts `2.0` as an integer, because some exporters write indices like this.
std::optional<std::size_t> SpanValue::whole() const {
  constexpr double kMost = 9007199254740992.0;  // 2^53
  const std::optional<double> value = number();
  if (!value || !(*value >= 0.0 && *value <= kMost)) return std::nullopt;
  const auto count = static_cast<std::size_t>(*value);
  return static_cast<double>(count) == *value ? std::make_optional(count) : std::nullopt;
}

std::vector<SpanValue> SpanValue::children() const {
  std::vector<SpanValue> all;
  all.reserve(size());
  for (std::size_t i = size() == 0 ? 0 : index_ + 1; i != 0; i = json_->nodes_[i].next)
    all.emplace_back(json_, i);
  return all;
}

SpanValue SpanValue::find(std::string_view key) const {
  SpanValue found;
  if (!is(SpanKind::kObject)) return found;
  for (std::size_t i = size() == 0 ? 0 : index_ + 1; i != 0; i = json_->nodes_[i].next)
    if (const SpanValue member(json_, i); member.has_key(key)) found = member;
  return found;
}

std::string utf8_of(std::uint32_t code) {
  std::string bytes;
  const auto rest = [&](unsigned shift) { bytes += static_cast<char>(0x80 | (code >> shift & 0x3f)); };
  if (code < 0x80) {
    bytes += static_cast<char>(code);
  } else if (code < 0x800) {
    bytes += static_cast<char>(0xc0 | code >> 6);
    rest(0);
  } else if (code < 0x10000) {
    bytes += static_cast<char>(0xe0 | code >> 12);
    rest(6);
    rest(0);
  } else {
    bytes += static_cast<char>(0xf0 | code >> 18);
    rest(12);
    rest(6);
    rest(0);
  }
  return bytes;
}

std::string quoted_json(std::string_view text) { return Json(text).dump(); }

}  // namespace remap
