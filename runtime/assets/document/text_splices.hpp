// This file edits a text by splices: some bytes are replaced, and no others move.
#pragma once

#include <string>
#include <string_view>
#include <vector>

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

}  // namespace remap
