// This file makes text from files and other programs safe for terminals, generated comments and messages,
// splits and joins words, and suggests corrections for mistyped names.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace remap {

// Limits text in a message that comes from an input file or another program. 2000 bytes are about one screen.
inline constexpr std::size_t kLongestMessage = 2000;

// Returns true if `text` is UTF-8 that looks the same in every program. It has no control characters and no
// line breaks of Unicode. It has no marks that change the direction of text (U+202E and the like), which can
// make a comment look like code.
bool is_plain_text(std::string_view text);

// Returns `text` with an escape (`\x1b`, `\u202e`) for every byte and character that is_plain_text() refuses.
// A text longer than `longest` bytes is cut and ends in `...`.
std::string plain(std::string_view text, std::size_t longest = kLongestMessage);

// Returns `text` in lower case, in every script. Bytes that are not UTF-8 stay unchanged.
std::string without_case(std::string_view text);

// Replaces every character that is_plain_text() refuses by `_`. This is for names of new files that come from
// texts of others. Keeps bytes that are not UTF-8, because file names may have other encodings.
std::string plain_file_name(std::string_view text);

// Returns the parts of `text` between separators. Parts may be empty, so there is one more part than
// separators.
std::vector<std::string> parts_between(std::string_view text, char separator);

// Returns a byte as URIs write it: `%2F`.
std::string percent_code(char byte);

// Returns `text` as one word of the shell, in quotes if it needs them.
std::string shell_word(const std::string& text);

// Returns the candidate with the smallest Damerau-Levenshtein distance to `name` (optimal string alignment),
// or an empty string if none is close. A candidate is close if at most a third of the letters of the longer
// name are wrong. A beginning such as --out is treated as one wrong letter if it is at least half of the
// candidate.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

// Returns the candidate with the smallest distance to `name`, even if it is not close. If several have this
// distance, returns the first. `candidates` must not be empty.
std::string closest_name(std::string_view name, std::span<const std::string> candidates);

// Returns up to `count` close candidates. Candidates that contain `name`, or that `name` contains, come
// first. The others follow in the order of their distance.
std::vector<std::string> nearest_names(std::string_view name, std::vector<std::string> candidates,
                                       std::size_t count);

// Returns `names` in one line, with `between` between two names.
std::string joined(std::span<const std::string> names, std::string_view between);
// Joins the texts that `text_of` makes of the items, in the same way.
template <typename Items, typename TextOf>
std::string joined(const Items& items, std::string_view between, TextOf text_of) {
  std::string text;
  for (const auto& item : items)
    (text += text.empty() ? std::string_view() : between) += std::invoke(text_of, item);
  return text;
}

// Returns the end of a message: ` (did you mean X?)` if a name is close, otherwise ` (choose A, B, C)`.
// Returns an empty text without candidates.
std::string suggestion(std::string_view name, std::span<const std::string> candidates);

}  // namespace remap
