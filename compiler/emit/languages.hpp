// This file writes converters in other languages, as a function for one texel. It has the same formula as
// the header.
#pragma once

#include <string>
#include <vector>

#include "lower/fit.hpp"
#include "remap/model.hpp"

namespace remap {

enum class Language { kC, kPython, kJavaScript, kGlsl, kHlsl, kMaterialX };
inline constexpr NamedValues<Language, 6> kLanguages = {{{Language::kC, "c"},
                                                         {Language::kPython, "python"},
                                                         {Language::kJavaScript, "javascript"},
                                                         {Language::kGlsl, "glsl"},
                                                         {Language::kHlsl, "hlsl"},
                                                         {Language::kMaterialX, "materialx"}}};

// Returns the extension of files in the language, such as `.h`.
std::string extension_of(Language language);

// Returns a file with a function for each fit, in order. `name` is the file's name without extension. Throws
// kNumeric for a fit without a converter.
std::string emit_functions(const std::vector<Fit>& fits, Language language, const std::string& name);

}  // namespace remap
