// Text from files and other programs, made fit for terminals, comments of generated code and messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace remap {

// The most bytes of a message of this project that tell of another's text: a screen of it.
inline constexpr std::size_t kLongestMessage = 2000;

// Whether `text` is UTF-8 that reads everywhere as it is written: no control characters, no line breaks of
// Unicode, and no marks that turn the direction of what follows (U+202E and the like), which can make a
// comment look like code and code like a comment.
bool is_plain_text(std::string_view text);

// `text` with every byte and character that is_plain_text() refuses written as an escape (`\x1b`, `\u202e`),
// cut to at most `longest` bytes, the last three of which are `...` where something is missing.
std::string plain(std::string_view text, std::size_t longest = kLongestMessage);

// `text` with small letters in place of capital ones, in every script; bytes that are no UTF-8 stay.
std::string without_case(std::string_view text);

// Replaces every character that is_plain_text() refuses by `_`, because names of new files are made of texts
// that others wrote. Keeps bytes that are not UTF-8, because file names may be in other encodings.
std::string plain_file_name(std::string_view text);

// The parts of `text` between separators; one more than there are separators, so parts may be empty.
std::vector<std::string> parts_between(std::string_view text, char separator);

// `%2F`, as URIs write a byte.
std::string percent_code(char byte);

// `text` as one word of the shell, in quotes where it needs them.
std::string shell_word(const std::string& text);

}  // namespace remap
