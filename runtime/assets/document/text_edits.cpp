#include "assets/document/text_edits.hpp"

#include <algorithm>

#include "core/errors.hpp"

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
  std::string appended;
  for (const std::string& text : changes.appended) appended += (appended.empty() ? "" : separator) + text;
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

}  // namespace remap
