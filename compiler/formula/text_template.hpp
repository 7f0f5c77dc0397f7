// This file writes the pieces of generated code: templates, literals and tables.
#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace remap {

// Returns `text` with every placeholder `@name@` replaced by its value, and REMAP_INDEPENDENT_LOOP by the
// pragmas of a loop with independent iterations. If a placeholder is the only text on its line, each line of
// its value gets the indentation of the line. If the value is empty, the line is removed. Throws
// std::logic_error for a placeholder without a value and for a value without a placeholder, because such a
// template is a bug.
std::string fill_template(std::string_view text, const std::map<std::string, std::string>& values);

// Returns the file NAME.in of compiler/emit/templates, or NAME.inc of a folder `code`, unchanged. Throws
// std::logic_error for an unknown name.
std::string_view code_file(std::string_view name);

// Returns files without placeholders one after another, each after an empty line.
std::string code_files(std::initializer_list<std::string_view> names);

// Returns ASCII letters as capitals, for include guards.
std::string upper_case(std::string text);

// Return the shortest literals that read back as the same number: for the float closest to `value`, and for
// the double. Throw kNumeric if a literal would not be finite.
std::string literal(double value);
std::string double_literal(double value);

// Returns `inline constexpr float NAME[rows][width] = {...};`, with one row on each line.
std::string table_code(const std::string& name, std::size_t width, const std::vector<std::string>& numbers);

}  // namespace remap
