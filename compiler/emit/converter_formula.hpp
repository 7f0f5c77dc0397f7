// A converter as statements: one formula for C99, Python, JavaScript, shaders, MaterialX and C++.
#pragma once

#include <string>
#include <vector>

#include "converter/converter_data.hpp"
#include "formula/expression.hpp"

namespace remap {

// From the inputs `width` (a number) and `specular` (a color) to `width_out` and `specular_out`, in the units
// of the models, in order. What no later statement uses is left out. Inputs beyond what was measured are held
// as headers hold them; NaN is not looked for.
std::vector<Statement> formula_of(const ConverterData& converter);

// Alpha of a model's own width parameter, and the parameter of alpha (runtime/include/remap/converter.hpp).
Expression alpha_of(RoughnessEncoding convention, const std::string& parameter);
Expression native_of(RoughnessEncoding convention, const std::string& parameter);

// The factors of a form (converter/compact_form.hpp) as expressions of `alpha` and `t`. Every evaluator has
// this order of operations.
Expression factor_expression(const FactorTerms& factor, const std::string& alpha, const std::string& t);

}  // namespace remap
