// This file scans JSON strictly, and stores the place of each value and key in the text. An editor
// (text_edits.hpp) can then replace some bytes without moving others. Numbers stay text, such as
// 9007199254740993 and 1E400, until somebody reads them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace remap {

// A TextSpan holds the bytes [begin, end) of a text.
struct TextSpan {
  std::size_t begin = 0, end = 0;

  std::string_view in(std::string_view text) const noexcept { return text.substr(begin, end - begin); }
  bool operator==(const TextSpan&) const = default;
};

enum class SpanKind : std::uint8_t { kNull, kBoolean, kNumber, kText, kList, kObject };

class SpanValue;

// Limits how deep values nest. Scanning, printing and destroying a value takes stack for each level, and
// 65,000 levels overflow it. Files of this project nest six deep.
inline constexpr std::size_t kDeepestJson = 100;
// Limits the text. It can be long, because a glTF file may have all its images inside. Each value takes 32
// bytes of memory.
inline constexpr std::size_t kLongestSpannedText = std::size_t{1} << 30,
                             kMostSpannedValues = std::size_t{1} << 23;

// A SpannedJson holds the values of a JSON text (RFC 8259). The text may begin with a byte order mark, and
// must outlive the object.
class SpannedJson {
 public:
  // Throws kInput, beginning with `context`, for a text that is not valid JSON or not UTF-8, with line and
  // column. Also throws it for a text nested deeper than kDeepestJson, or beyond the limits above.
  SpannedJson(std::string_view text, const std::string& context);

  std::string_view text() const noexcept { return text_; }
  SpanValue root() const noexcept;
  // Values come in the order of the text. The values of a list or object follow it.
  std::size_t value_count() const noexcept { return nodes_.size(); }
  SpanValue value(std::size_t index) const noexcept;

 private:
  friend class SpanValue;
  friend class SpanScanner;
  struct Node {
    std::uint32_t begin = 0, end = 0;
    std::uint32_t key_begin = 0, key_end = 0;  // range of the key with its quotes; empty without a key
    std::uint32_t parent = 0, next = 0;        // index of the parent, and of its next child; 0: none
    std::uint32_t count = 0;                   // number of entries or members, which follow this node
    SpanKind kind = SpanKind::kNull;
  };

  std::string_view text_;
  std::vector<Node> nodes_;
};

// A SpanValue is a value of a SpannedJson. It must not outlive the SpannedJson. An empty SpanValue has
// neither members nor a number.
class SpanValue {
 public:
  SpanValue() = default;
  SpanValue(const SpannedJson* json, std::size_t index) : json_(json), index_(index) {}

  explicit operator bool() const noexcept { return json_ != nullptr; }
  bool operator==(const SpanValue&) const = default;
  std::size_t index() const noexcept { return index_; }  // index for SpannedJson::value()
  SpanKind kind() const noexcept { return json_ != nullptr ? node().kind : SpanKind::kNull; }
  bool is(SpanKind kind) const noexcept { return json_ != nullptr && node().kind == kind; }
  TextSpan span() const noexcept { return {node().begin, node().end}; }
  // Returns the key of the member with its quotes, or an empty span if this is not a member.
  TextSpan key_span() const noexcept { return {node().key_begin, node().key_end}; }
  std::string key() const;
  bool has_key(std::string_view key) const;
  SpanValue parent() const noexcept;
  // Returns the bytes of the value unchanged.
  std::string_view raw() const noexcept;
  // Returns the text without escapes, or nothing if this is not a text.
  std::optional<std::string> text() const;
  // Returns the number if a double can hold it, and nothing for other values.
  std::optional<double> number() const;
  // Returns a non-negative integer, which glTF uses for indices. Returns nothing for other values.
  std::optional<std::size_t> whole() const;
  std::size_t size() const noexcept { return json_ != nullptr ? node().count : 0; }
  // Returns the entries of a list or the members of an object, including repeated keys.
  std::vector<SpanValue> children() const;
  // Returns the entries of a list, and nothing for other values.
  std::vector<SpanValue> entries() const {
    return is(SpanKind::kList) ? children() : std::vector<SpanValue>();
  }
  // Returns the member of an object. If a key is repeated, the last member is used, as in JSON libraries.
  SpanValue find(std::string_view key) const;
  SpanValue operator[](std::string_view key) const { return find(key); }

 private:
  const SpannedJson::Node& node() const noexcept { return json_->nodes_[index_]; }
  const SpannedJson* json_ = nullptr;
  std::size_t index_ = 0;
};

// Returns a code point as UTF-8.
std::string utf8_of(std::uint32_t code);

// Returns `text` as a JSON text in quotes.
std::string quoted_json(std::string_view text);

}  // namespace remap
