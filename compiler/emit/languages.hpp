// This file writes converters in other languages, as a function for one texel. It has the same formula as the
// header. It first writes a converter as statements, from which all languages are made.
#pragma once

#include <string>
#include <vector>

#include "converter/converter_data.hpp"
#include "formula/expression.hpp"
#include "lower/fit.hpp"
#include "remap/model.hpp"

namespace remap {

// Returns statements that compute `width_out` and `specular_out` from `width` (a number) and `specular` (a
// color), in the units of the models. Statements that nothing uses are left out. Beyond the measured range,
// results equal those of generated headers, except that NaN is not treated.
std::vector<Statement> formula_of(const ConverterData& converter);

// Return the formula of alpha for a model's own width parameter, and the formula of the width parameter for
// alpha (runtime/include/remap/converter.hpp).
Expression alpha_of(RoughnessEncoding convention, const std::string& parameter);
Expression native_of(RoughnessEncoding convention, const std::string& parameter);

// Returns a factor of a form (converter/compact_form.hpp) as an expression of `alpha` and `t`. All evaluators
// have the same order of operations.
Expression factor_expression(const FactorTerms& factor, const std::string& alpha, const std::string& t);

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
