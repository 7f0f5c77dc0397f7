// Edits of a text as splices: some bytes are replaced, and no others move.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/json_spans.hpp"

namespace remap {

// `text` in place of the bytes of `span`, which may be none.
struct TextSplice {
  TextSpan span;
  std::string text;
};

// Sorts splices by their places. Those of one place keep their order.
void sort_splices(std::vector<TextSplice>& splices);

// The text with sorted splices. Throws kNumeric where two touch the same bytes, a fault of the caller.
std::string spliced(std::string_view text, const std::vector<TextSplice>& splices);

// The bytes that sorted splices replace; those that are inserted have none.
std::vector<TextSpan> touched_by(const std::vector<TextSplice>& splices);

}  // namespace remap
