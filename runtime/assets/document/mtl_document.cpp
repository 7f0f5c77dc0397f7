#include "assets/document/mtl_document.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/errors.hpp"
#include "core/number_text.hpp"

namespace remap {
namespace {

constexpr std::string_view kMarkOfUtf8 = "\xef\xbb\xbf";

}  // namespace

std::string in_lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

MtlDocument::MtlDocument(std::string_view text, const std::string& context) : text_(text) {
  if (text.size() > kLongestMtl)
    throw input_error(context + ": has " + std::to_string(text.size()) + " bytes, but at most " +
                      std::to_string(kLongestMtl) + " can be read (split it into several files)");
  std::size_t at = text.starts_with(kMarkOfUtf8) ? kMarkOfUtf8.size() : 0;
  while (at < text.size()) {
    const std::size_t end = end_of_line(at);
    add_line(at, end);
    if (statements_.size() > kMostMtlStatements)
      throw input_error(context + ": has more than " + std::to_string(kMostMtlStatements) +
                        " statements (split it into several files)");
    at = end + ending_length(end);
  }
  if (!materials_.empty()) materials_.back().last = statements_.size();
}

// Returns the length of `\n`, `\r\n` or `\r` at `at`, or 0.
std::size_t MtlDocument::ending_length(std::size_t at) const {
  if (at >= text_.size()) return 0;
  if (text_[at] == '\r') return at + 1 < text_.size() && text_[at + 1] == '\n' ? 2 : 1;
  return text_[at] == '\n' ? 1 : 0;
}

// Returns the end of a comment, which is its first line ending. A backslash before the line ending does not
// continue the comment, because it may be part of a Windows path.
std::size_t MtlDocument::end_of_line(std::size_t begin) const {
  std::size_t at = begin;
  while (at < text_.size() && is_space(at)) at += space_length(at);
  const bool is_comment = at < text_.size() && text_[at] == '#';
  for (;;) {
    at = std::min(text_.find_first_of("\r\n", at), text_.size());
    if (is_comment || at == begin || at >= text_.size() || text_[at - 1] != '\\') return at;
    at += ending_length(at);
  }
}

bool MtlDocument::is_space(std::size_t at) const { return space_length(at) > 0; }

// Treats a backslash before a line ending as white space, together with the line ending.
std::size_t MtlDocument::space_length(std::size_t at) const {
  const char c = text_[at];
  if (c == ' ' || c == '\t' || c == '\v' || c == '\f') return 1;
  if (c != '\\') return 0;
  const std::size_t ending = ending_length(at + 1);
  return ending == 0 ? 0 : 1 + ending;
}

void MtlDocument::add_line(std::size_t begin, std::size_t end) {
  std::size_t at = begin;
  while (at < end && is_space(at)) at += space_length(at);
  if (at >= end || text_[at] == '#') return;
  MtlStatement statement;
  statement.line = {begin, end};
  statement.ending = {end, end + ending_length(end)};
  statement.word.begin = at;
  while (at < end && !is_space(at)) ++at;
  statement.word.end = at;
  while (at < end && is_space(at)) at += space_length(at);
  statement.arguments = {std::min(at, end), std::min(at, end)};
  for (; at < end; at += std::max<std::size_t>(space_length(at), 1))
    if (!is_space(at)) statement.arguments.end = at + 1;
  if (in_lower_case(raw(statement.word)) == "newmtl") {
    if (!materials_.empty()) materials_.back().last = statements_.size();
    materials_.push_back({rest(statement), statements_.size(), 0});
  }
  statements_.push_back(statement);
}

std::string MtlDocument::word(const MtlStatement& statement) const {
  return in_lower_case(raw(statement.word));
}

std::vector<TextSpan> MtlDocument::words(const MtlStatement& statement) const {
  std::vector<TextSpan> spans;
  const std::size_t end = statement.arguments.end;
  for (std::size_t at = statement.arguments.begin; at < end;) {
    const std::size_t begin = at;
    while (at < end && !is_space(at)) ++at;
    spans.push_back({begin, at});
    while (at < end && is_space(at)) at += space_length(at);
  }
  return spans;
}

std::string MtlDocument::rest(const MtlStatement& statement) const {
  std::string result;
  for (std::size_t at = statement.arguments.begin; at < statement.arguments.end;) {
    const std::size_t length = space_length(at);
    result += length > 1 ? ' ' : text_[at];
    at += std::max<std::size_t>(length, 1);
  }
  return result;
}

std::string_view MtlDocument::line_ending() const noexcept {
  std::array<std::size_t, 3> counts{};
  constexpr std::array<std::string_view, 3> kEndings = {"\n", "\r\n", "\r"};
  for (const MtlStatement& statement : statements_)
    for (std::size_t i = 0; i < kEndings.size(); ++i)
      if (raw(statement.ending) == kEndings[i]) ++counts[i];
  return kEndings[static_cast<std::size_t>(std::ranges::max_element(counts) - counts.begin())];
}

namespace {

constexpr double kNewScaleSince = 3.4;

// Detects Blender 2.7, which wrote 1000 / 510 for each step of its hardness, an integer from 1 to 511.
bool has_steps_of_hardness(const MtlDocument& document) {
  constexpr double kStep = 1000.0 / 510.0, kRounding = 1e-5;
  std::size_t exponents = 0;
  for (const MtlStatement& statement : document.statements()) {
    if (document.word(statement) != "ns") continue;
    const auto exponent = parse_number(document.rest(statement));
    if (!exponent || std::fabs(std::remainder(*exponent, kStep)) > kRounding) return false;
    ++exponents;
  }
  return exponents > 0;
}

MtlMaker blender_of(const MtlDocument& document, std::string_view version) {
  version = version.substr(0, version.find_first_not_of("0123456789."));
  const auto number = parse_number(version.substr(0, version.find('.', version.find('.') + 1)));
  if (number) return *number < kNewScaleSince ? MtlMaker::kBlender28 : MtlMaker::kBlender;
  return has_steps_of_hardness(document) ? MtlMaker::kText : MtlMaker::kBlender28;
}

}  // namespace

MtlMaker maker_of(const MtlDocument& document) {
  const std::size_t first =
      document.statements().empty() ? document.text().size() : document.statements().front().line.begin;
  const std::string_view header = document.text().substr(0, first);
  constexpr std::string_view kBlender = "# Blender ", kTitle = "MTL File";
  if (const std::size_t found = header.find(kBlender); found != std::string_view::npos) {
    std::string_view line = header.substr(found + kBlender.size());
    line = line.substr(0, line.find_first_of("\r\n"));
    if (const std::size_t title = line.find(kTitle); title != std::string_view::npos)
      return blender_of(document, line.substr(line.starts_with('v') ? 1 : 0, title));
  }
  for (const MtlStatement& statement : document.statements())
    if (document.word(statement) == "bsdf" && in_lower_case(document.rest(statement)) == "pbr")
      return MtlMaker::kNvdiffrec;
  return MtlMaker::kText;
}

double blender_scale(MtlMaker maker) { return maker == MtlMaker::kBlender28 ? 900.0 : 1000.0; }

std::string maker_warning(MtlMaker maker) {
  const auto blender = [maker] {
    return "was written by Blender: texremap reads roughness as 1 - sqrt(Ns / " +
           number_text(blender_scale(maker)) +
           "), metallic from Ka and illum, and ignores Kd if there is map_Kd (--from mtl reads "
           "the file by the MTL specification)";
  };
  switch (maker) {
    case MtlMaker::kText:
      return "";
    case MtlMaker::kBlender:
    case MtlMaker::kBlender28:
      return blender();
    case MtlMaker::kNvdiffrec:
      return "has the line bsdf pbr: texremap reads roughness and metallic from green and blue of Ks (--from "
             "mtl reads the file by the MTL specification)";
  }
  return "";
}

}  // namespace remap
