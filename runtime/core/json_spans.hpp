// JSON as places in its text: a strict scanner that keeps where each value and key stands, so that an editor
// (text_edits.hpp) replaces some bytes and moves no others. Numbers stay text: 9007199254740993 and 1E400 are
// not read unless somebody asks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace remap {

// Bytes [begin, end) of a text.
struct TextSpan {
  std::size_t begin = 0, end = 0;
  bool operator==(const TextSpan&) const = default;
};

enum class SpanKind : std::uint8_t { kNull, kBoolean, kNumber, kText, kList, kObject };

class SpanValue;

// Values within values. Files of this project nest six deep; scanning, printing and destroying a value take
// stack for each level, of which 65,000 are too many.
inline constexpr std::size_t kDeepestJson = 100;
// The largest text that is scanned: a glTF file with everything embedded. A value takes 32 bytes of memory.
inline constexpr std::size_t kLongestSpannedText = std::size_t{1} << 30,
                             kMostSpannedValues = std::size_t{1} << 23;

// The values of a JSON text (RFC 8259), which may begin with a byte order mark. `text` must outlive it.
class SpannedJson {
 public:
  // Throws kInput, beginning with `context`, for a text that is not valid JSON or not UTF-8, with line and
  // column, for one nested deeper than kDeepestJson, and beyond the limits above.
  SpannedJson(std::string_view text, const std::string& context);

  std::string_view text() const noexcept { return text_; }
  SpanValue root() const noexcept;
  // In the order of the text; values of a list or object follow it.
  std::size_t value_count() const noexcept { return nodes_.size(); }
  SpanValue value(std::size_t index) const noexcept;

 private:
  friend class SpanValue;
  friend class SpanScanner;
  struct Node {
    std::uint32_t begin = 0, end = 0;
    std::uint32_t key_begin = 0, key_end = 0;  // with its quotes; equal without a key
    std::uint32_t parent = 0, next = 0;        // next: of the same parent, 0 for none
    std::uint32_t count = 0;                   // of entries or members, which start at the next node
    SpanKind kind = SpanKind::kNull;
  };

  std::string_view text_;
  std::vector<Node> nodes_;
};

// A value of a SpannedJson, which must outlive it; or none, which has neither members nor a number.
class SpanValue {
 public:
  SpanValue() = default;
  SpanValue(const SpannedJson* json, std::size_t index) : json_(json), index_(index) {}

  explicit operator bool() const noexcept { return json_ != nullptr; }
  bool operator==(const SpanValue&) const = default;
  std::size_t index() const noexcept { return index_; }  // of SpannedJson::value()
  SpanKind kind() const noexcept { return json_ != nullptr ? node().kind : SpanKind::kNull; }
  bool is(SpanKind kind) const noexcept { return json_ != nullptr && node().kind == kind; }
  TextSpan span() const noexcept { return {node().begin, node().end}; }
  // The key of the member, with its quotes; empty if this is not a member.
  TextSpan key_span() const noexcept { return {node().key_begin, node().key_end}; }
  std::string key() const;
  bool has_key(std::string_view key) const;
  SpanValue parent() const noexcept;
  // The bytes as they stand.
  std::string_view raw() const noexcept;
  // The text without escapes; none for other values.
  std::optional<std::string> text() const;
  // The number, if a double can hold it; none for other values.
  std::optional<double> number() const;
  // The whole number from 0, as glTF counts; none for other values.
  std::optional<std::size_t> whole() const;
  std::size_t size() const noexcept { return json_ != nullptr ? node().count : 0; }
  // Entries of a list or members of an object, repeated keys among them.
  std::vector<SpanValue> children() const;
  // Entries of a list; none of other values.
  std::vector<SpanValue> entries() const {
    return is(SpanKind::kList) ? children() : std::vector<SpanValue>();
  }
  // The member of an object; of several with one key the last, as JSON libraries read it.
  SpanValue find(std::string_view key) const;
  SpanValue operator[](std::string_view key) const { return find(key); }

 private:
  const SpannedJson::Node& node() const noexcept { return json_->nodes_[index_]; }
  const SpannedJson* json_ = nullptr;
  std::size_t index_ = 0;
};

// The bytes of a code point in UTF-8.
std::string utf8_of(std::uint32_t code);

// `text` in quotes.
std::string quoted_json(std::string_view text);

}  // namespace remap
