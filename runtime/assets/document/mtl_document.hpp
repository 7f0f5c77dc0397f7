// This file finds the statements and materials of a Wavefront MTL file, as places in its text. An editor can
// then replace some bytes without moving others. Unknown lines stay unchanged. The file also detects the
// program that wrote an MTL file, because some programs give statements another meaning than the
// specification.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/json_spans.hpp"
#include "remap/model.hpp"

namespace remap {

// Limits the text, and the number of lines with a statement; each such line takes 56 bytes of memory.
inline constexpr std::size_t kLongestMtl = std::size_t{1} << 28, kMostMtlStatements = std::size_t{1} << 23;

// An MtlStatement holds the places of a statement in the text.
struct MtlStatement {
  // This is the line from its indentation to its ending, without the ending. Lines that backslashes join are
  // one line.
  TextSpan line;
  TextSpan ending;     // line ending of `line`; empty at the end of the text
  TextSpan word;       // `Kd`
  TextSpan arguments;  // without the white space around them; may be empty
};

// An MtlBlock is a material and its statements, beginning with `newmtl`.
struct MtlBlock {
  std::string name;  // may be empty
  std::size_t first = 0, last = 0;
};

class MtlDocument {
 public:
  // Scans `text`, which must outlive this object. Beyond the limits it throws kInput with `context`.
  MtlDocument(std::string_view text, const std::string& context);

  std::string_view text() const noexcept { return text_; }
  std::string_view raw(TextSpan span) const noexcept { return span.in(text_); }
  // Returns the statements in the order of the text, without blank lines and comments. Statements before the
  // first material belong to no material.
  const std::vector<MtlStatement>& statements() const noexcept { return statements_; }
  const std::vector<MtlBlock>& materials() const noexcept { return materials_; }
  // Returns the word of a statement in lower case, because tools differ (map_bump, map_Bump).
  std::string word(const MtlStatement& statement) const;
  // Returns the arguments, which white space separates.
  std::vector<TextSpan> words(const MtlStatement& statement) const;
  // Returns the arguments as one text, because names may contain spaces.
  std::string rest(const MtlStatement& statement) const;
  // Returns the most common line ending, or `\n` if there is none.
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

// Converts ASCII letters to lower case.
std::string in_lower_case(std::string_view text);

enum class MtlMaker {
  kText,       // unknown; statements mean what the specification says (Alias|Wavefront 1995)
  kBlender,    // Blender 3.4 and later: Ns is 1000 (1 - roughness)^2
  kBlender28,  // Blender 2.8 to 3.3: Ns is 900 (1 - roughness)^2
  kNvdiffrec,  // `bsdf pbr`: map_Ks holds roughness in green and metallic in blue (Munkberg et al. 2022)
};
inline constexpr NamedValues<MtlMaker, 4> kMtlMakers = {{{MtlMaker::kText, "mtl"},
                                                         {MtlMaker::kBlender, "blender"},
                                                         {MtlMaker::kBlender28, "blender-2.8"},
                                                         {MtlMaker::kNvdiffrec, "nvdiffrec"}}};

// Returns the maker that the first comments name, or whose special statements occur. Otherwise, returns
// kText. Also returns kText for Blender 2.7, which wrote the exponents of its Blinn and Phong shaders, as the
// specification describes them.
MtlMaker maker_of(const MtlDocument& document);

// Returns a warning that the file is read as this maker writes it: `was written by Blender: ...`. Returns
// nothing for kText.
std::string maker_warning(MtlMaker maker);

// Returns the Ns that Blender writes for roughness 0.
double blender_scale(MtlMaker maker);

}  // namespace remap
