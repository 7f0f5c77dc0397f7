#include "assets/document/text_splices.hpp"

#include <algorithm>

#include "core/errors.hpp"

namespace remap {

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
