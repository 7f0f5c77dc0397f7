// A Wavefront MTL file as places in its text: statements, and the material that each belongs to, so that an
// editor replaces some bytes and moves no others. Lines that are not known stay as they are.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/json_spans.hpp"

namespace remap {

// The largest text that is scanned, and the most lines that say something; such a line takes 56 bytes.
inline constexpr std::size_t kLongestMtl = std::size_t{1} << 28, kMostMtlStatements = std::size_t{1} << 23;

// Bytes of a text that do not change.
struct MtlStatement {
  TextSpan line;       // from the indentation to before the line ending; a backslash joins lines
  TextSpan ending;     // of the line; empty at the end of the text
  TextSpan word;       // `Kd`
  TextSpan arguments;  // without the white space around them; may be empty
};

// A material and its statements, `newmtl` the first of them.
struct MtlBlock {
  std::string name;  // may be empty
  std::size_t first = 0, last = 0;
};

class MtlDocument {
 public:
  // `text` must outlive it. Throws kInput, beginning with `context`, beyond the limits above.
  MtlDocument(std::string_view text, const std::string& context);

  std::string_view text() const noexcept { return text_; }
  std::string_view raw(TextSpan span) const noexcept {
    return text_.substr(span.begin, span.end - span.begin);
  }
  // The statements in the order of the text, without blank lines and comments. Statements before the first
  // material belong to no material.
  const std::vector<MtlStatement>& statements() const noexcept { return statements_; }
  const std::vector<MtlBlock>& materials() const noexcept { return materials_; }
  // The word of a statement in lower case: tools differ (map_bump, map_Bump).
  std::string word(const MtlStatement& statement) const;
  // The arguments, which white space separates.
  std::vector<TextSpan> words(const MtlStatement& statement) const;
  // The arguments as one text, as names with spaces are written.
  std::string rest(const MtlStatement& statement) const;
  // The most common one; that of Unix where there is none.
  std::string_view line_ending() const noexcept;

 private:
  std::size_t end_of_line(std::size_t begin) const;
  std::size_t ending_length(std::size_t at) const;
  bool is_space(std::size_t at) const;
  std::size_t space_length(std::size_t at) const;
  void add_line(std::size_t begin, std::size_t end);

  std::string_view text_;
  std::vector<MtlStatement> statements_;
  std::vector<MtlBlock> materials_;
};

// ASCII letters in lower case.
std::string in_lower_case(std::string_view text);

}  // namespace remap
