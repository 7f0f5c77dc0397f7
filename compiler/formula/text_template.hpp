// This file writes every piece of generated code: templates, literals, lists and tables.
#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace remap {

// Returns `text` with every `@name@` replaced by its value, and REMAP_INDEPENDENT_LOOP by the pragmas of a
// loop with independent iterations. If a hole is the only text on its line, each line of its value gets the
// indentation of the line. Such a hole vanishes with its line if the value is empty. Throws std::logic_error
// for a hole without value and for a value without hole: a template that does not fit its caller is a bug.
std::string fill_template(std::string_view text, const std::map<std::string, std::string>& values);

// Returns the file NAME.in of compiler/emit/templates or NAME.inc of a folder `code`, unchanged. Throws
// std::logic_error for an unknown name.
std::string_view code_file(std::string_view name);

// Returns files without holes one after another, each after an empty line.
std::string code_files(std::initializer_list<std::string_view> names);

// Returns the texts of the elements of `list`, with `between` between two of them.
template <typename List, typename Text>
std::string joined(const List& list, std::string_view between, const Text& text_of) {
  std::string text;
  for (const auto& element : list) text.append(text.empty() ? "" : between).append(text_of(element));
  return text;
}

// Returns ASCII letters as capitals, for include guards.
std::string upper_case(std::string text);

// Return the shortest literals that read back: for the float closest to `value`, and for the double. Throw
// kNumeric if they would not be finite.
std::string literal(double value);
std::string double_literal(double value);

// Returns `inline constexpr float NAME[rows][width] = {...};`, with one row on each line.
std::string table_code(const std::string& name, std::size_t width, const std::vector<std::string>& numbers);

}  // namespace remap
