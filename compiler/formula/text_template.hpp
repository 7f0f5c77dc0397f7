// How every piece of generated code is written down: templates, literals, lists and tables.
#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace remap {

// Returns `text` with every `@name@` replaced by its value, and REMAP_INDEPENDENT_LOOP by the pragmas of a
// loop whose iterations do not wait for each other. A hole that stands alone on its line takes the
// indentation of the line for each line of its value, and vanishes with its line where the value is empty.
// Throws std::logic_error for a hole without value and for a value without hole: a template that does not fit
// its handler is a bug.
std::string fill_template(std::string_view text, const std::map<std::string, std::string>& values);

// The file NAME.in of compiler/emit/templates or NAME.inc of a folder `code`, as it is. Throws
// std::logic_error for an unknown name.
std::string_view code_file(std::string_view name);

// Files without holes one after another, each opened by an empty line.
std::string code_files(std::initializer_list<std::string_view> names);

// The texts of the elements of `list`, `between` them.
template <typename List, typename Text>
std::string joined(const List& list, std::string_view between, const Text& text_of) {
  std::string text;
  for (const auto& element : list) text.append(text.empty() ? "" : between).append(text_of(element));
  return text;
}

// ASCII letters as capitals, for include guards.
std::string upper_case(std::string text);

// The shortest literals that read back: of the float nearest to `value`, and of the double. Throws kNumeric
// where they would not be finite.
std::string literal(double value);
std::string double_literal(double value);

// `inline constexpr float NAME[rows][width] = {...};`, with one row on each line.
std::string table_code(const std::string& name, std::size_t width, const std::vector<std::string>& numbers);

}  // namespace remap
