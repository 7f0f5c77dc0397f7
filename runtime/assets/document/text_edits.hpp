// This file edits texts. Some bytes are replaced, and no others move. In a JSON text it replaces values, and
// appends or removes members and entries with their comma. Texts are read and edited as UTF-8, also files in
// UTF-16, as Windows tools write them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "assets/document/asset.hpp"
#include "core/json_spans.hpp"

namespace remap {

// A TextSplice puts `text` where the bytes of `span` are. The span may be empty.
struct TextSplice {
  TextSpan span;
  std::string text;
};

// Sorts splices by their places. Splices at the same place keep their order.
void sort_splices(std::vector<TextSplice>& splices);

// Returns the text with sorted splices. Throws kNumeric if two touch the same bytes, which is a mistake of
// the caller.
std::string spliced(std::string_view text, const std::vector<TextSplice>& splices);

// Returns the bytes that sorted splices replace. Insertions replace no bytes.
std::vector<TextSpan> touched_by(const std::vector<TextSplice>& splices);

class TextEdits {
 public:
  // Edits the text of `json`, which must outlive this object.
  explicit TextEdits(const SpannedJson& json) : json_(json) {}

  bool empty() const noexcept { return replaced_.empty() && changed_.empty(); }
  // Replaces a value by `text`, which must be JSON. No other edit may change a part of `value`.
  void replace(SpanValue value, std::string text);
  // Removes an entry or a member. No other edit may change a part of it.
  void remove(SpanValue child);
  void remove_members(SpanValue object, std::string_view key);
  // Appends a member after the last member, with the white space that other members have.
  void append_member(SpanValue object, std::string_view key, const std::string& text);
  void append_entry(SpanValue list, const std::string& text);
  // Replaces the value of a member, or appends the member.
  void set_member(SpanValue object, std::string_view key, const std::string& text);

  // Returns the bytes that are replaced, in order. Insertions replace no bytes.
  std::vector<TextSpan> touched() const;
  // Returns the edited text. Throws kNumeric if two edits touch the same bytes, which is a mistake of the
  // caller.
  std::string result() const;

 private:
  // A Changes holds the edits to the children of a list or object.
  struct Changes {
    std::set<std::size_t> removed;      // indices of values
    std::vector<std::string> appended;  // entries, or members with their keys
  };

  std::vector<TextSplice> splices() const;
  void add_splices(SpanValue container, const Changes& changes, std::vector<TextSplice>& splices) const;
  // These return the white space before the last child, and the white space between its key and value.
  std::string_view space_before(SpanValue child) const;
  std::string colon_of(SpanValue object) const;

  const SpannedJson& json_;
  std::map<std::size_t, std::string> replaced_;  // keyed by the index of the value
  std::map<std::size_t, Changes> changed_;       // keyed by the index of the list or object
};

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
