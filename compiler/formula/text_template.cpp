#include "formula/text_template.hpp"

#include <cmath>
#include <set>
#include <stdexcept>

#include "core/errors.hpp"
#include "core/number_text.hpp"

namespace remap {
namespace {

constexpr std::string_view kLoopMark = "REMAP_INDEPENDENT_LOOP";
// This comes before a loop whose output rows either are its input rows, or overlap no other row. Compilers
// then omit the check for overlap.
constexpr std::string_view kIndependentLoop = R"(#if defined(__clang__)
#pragma clang loop vectorize(assume_safety)
#elif defined(__GNUC__)
#pragma GCC ivdep
#elif defined(_MSC_VER)
#pragma loop(ivdep)
#endif)";

// Returns `text` with `indentation` at the start of every line except the first. Empty lines stay empty.
std::string indented(std::string_view text, const std::string& indentation) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    result += text[i];
    if (text[i] == '\n' && i + 1 < text.size() && text[i + 1] != '\n') result += indentation;
  }
  return result;
}

// Fills the placeholders of one line. If a value has several lines, all of them get the indentation of this
// line.
std::string fill_line(std::string_view line, const std::map<std::string, std::string>& values,
                      std::set<std::string>* used) {
  const std::string indentation(line.substr(0, line.find_first_not_of(' ')));
  if (line.substr(indentation.size()) == kLoopMark)
    return indentation + indented(kIndependentLoop, indentation) + "\n";
  std::string filled;
  bool vanishes = false;
  while (!line.empty()) {
    const std::size_t start = line.find('@');
    filled += line.substr(0, start);
    if (start == std::string_view::npos) break;
    const std::size_t end = line.find('@', start + 1);
    if (end == std::string_view::npos) throw std::logic_error("template: an @ without partner");
    const std::string name(line.substr(start + 1, end - start - 1));
    const auto value = values.find(name);
    if (value == values.end()) throw std::logic_error("template: no value for @" + name + "@");
    used->insert(name);
    const bool alone = filled == indentation && end + 1 == line.size();
    vanishes = alone && value->second.empty();
    std::string_view text = value->second;
    if (alone && text.ends_with('\n')) text.remove_suffix(1);  // the caller adds the newline
    filled += indented(text, indentation);
    line.remove_prefix(end + 1);
  }
  return vanishes ? "" : filled + "\n";
}

}  // namespace

std::string fill_template(std::string_view text, const std::map<std::string, std::string>& values) {
  std::string filled;
  std::set<std::string> used;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    filled += fill_line(text.substr(0, end), values, &used);
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  for (const auto& [name, value] : values)
    if (!used.contains(name)) throw std::logic_error("template: no hole for @" + name + "@");
  return filled;
}

std::string code_files(std::initializer_list<std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text += "\n" + fill_template(code_file(name), {});
  return text;
}

std::string upper_case(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

std::string literal(double value) { return float_literal(static_cast<float>(value)); }

std::string double_literal(double value) {
  if (!std::isfinite(value)) throw numeric_error("emit: a number is not finite");
  const std::string text = number_text(value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string table_code(const std::string& name, std::size_t width, const std::vector<std::string>& numbers) {
  std::string text = "inline constexpr float " + name + "[" + std::to_string(numbers.size() / width) + "][" +
                     std::to_string(width) + "] = {\n";
  for (std::size_t i = 0; i < numbers.size(); ++i)
    text += (i % width == 0 ? "    {" : ", ") + numbers[i] + ((i + 1) % width == 0 ? "},\n" : "");
  return text + "};\n";
}

}  // namespace remap
