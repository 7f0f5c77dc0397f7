// This file makes C++ and other languages from fits: a generated header for each fit, functions for one
// texel, and the data of all fits for texremap. Equal fits give equal bytes on every machine. The functions
// have the same formula as the header. A converter is first written as statements, from which all languages
// are made.
#pragma once

#include <string>
#include <vector>

#include "converter/converter_data.hpp"
#include "formula/expression.hpp"
#include "lower/fit.hpp"
#include "lower/fit_file.hpp"
#include "remap/model.hpp"

namespace remap {

// Returns the generated header `<id>.hpp`. Throws kNumeric for a fit without a converter and if a number is
// not finite as a float.
std::string emit_header(const Fit& fit);

// Return the generated headers for converters of whole materials. A warp has the specular workflow on both
// sides. Both functions throw the errors of require_valid().
std::string emit_header(const WorkflowFit& fit);
std::string emit_header(const WarpMapFit& fit);

// An EmittedFile is made from all fits together.
struct EmittedFile {
  std::string name;  // path within the folder of headers
  std::string text;
};

// Returns the files that are made from all fits together, in the order of their ids. `converters.json` is the
// data of texremap. The converters between models of the hub, and of exponents, are written in each language
// (`languages/converters.h`, ...). Throws kNumeric for a fit without a converter.
std::vector<EmittedFile> emit_shared_files(std::vector<Fit> fits);

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
