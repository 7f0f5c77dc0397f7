// Edits of a JSON text: values are replaced, members and entries appended or removed with their comma, and no
// other byte moves.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "assets/document/text_splices.hpp"
#include "core/json_spans.hpp"

namespace remap {

class TextEdits {
 public:
  // `json` must outlive this.
  explicit TextEdits(const SpannedJson& json) : json_(json) {}

  bool empty() const noexcept { return replaced_.empty() && changed_.empty(); }
  // `text` is JSON. Nothing inside of `value` may be edited otherwise.
  void replace(SpanValue value, std::string text);
  // Removes an entry or a member. Nothing inside of it may be edited.
  void remove(SpanValue child);
  // Removes every member of that key.
  void remove_members(SpanValue object, std::string_view key);
  // After the last entry or member that there is, with the white space that stands between others.
  void append_member(SpanValue object, std::string_view key, const std::string& text);
  void append_entry(SpanValue list, const std::string& text);
  // Replaces the value of a member, or appends the member.
  void set_member(SpanValue object, std::string_view key, const std::string& text);

  // The bytes that are replaced, in order; those that are inserted have none.
  std::vector<TextSpan> touched() const;
  // The edited text. Throws kNumeric where two edits touch the same bytes, a fault of the caller.
  std::string result() const;

 private:
  // The edits of the children of a list or object.
  struct Changes {
    std::set<std::size_t> removed;      // indices of values
    std::vector<std::string> appended;  // entries, or members with their keys
  };

  std::vector<TextSplice> splices() const;
  void add_splices(SpanValue container, const Changes& changes, std::vector<TextSplice>& splices) const;
  // White space before the last child, and between its key and value.
  std::string_view space_before(SpanValue child) const;
  std::string colon_of(SpanValue object) const;

  const SpannedJson& json_;
  std::map<std::size_t, std::string> replaced_;  // by the index of the value
  std::map<std::size_t, Changes> changed_;       // by the index of the list or object
};

}  // namespace remap
