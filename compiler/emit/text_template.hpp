// Text with named holes: how every piece of generated code is written down.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace remapc {

// `text` with every `@name@` replaced by its value. A hole that stands alone on its line takes the
// indentation of the line for each line of its value, and vanishes with its line where the value is empty.
// Throws std::logic_error for a hole without value and for a value without hole: a template that does not fit
// its handler is a bug.
std::string fill_template(std::string_view text, const std::map<std::string, std::string>& values);

}  // namespace remapc
