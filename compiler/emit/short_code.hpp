// Short forms in the languages of importers. Pure: the same forms give the same bytes on every machine.
#pragma once

#include <string>
#include <vector>

#include "lower/short_form.hpp"

namespace remap {

struct ShortCode {
  std::string extension;  // `.h`
  std::string content;
};

// C99, C++17, Python, JavaScript (a module), MaterialX 1.38, and the table as CSV and JSON.
std::vector<ShortCode> short_code(const std::vector<ShortForm>& forms);

// The lines of a form, as people write them: `alpha (0.71 + 0.23 alpha)`.
std::string short_text(const ShortForm& form);

}  // namespace remap
