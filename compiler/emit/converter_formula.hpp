// This file writes a converter as statements. From these, remapc makes C99, Python, JavaScript, shaders,
// MaterialX and C++.
#pragma once

#include <string>
#include <vector>

#include "converter/converter_data.hpp"
#include "formula/expression.hpp"

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

}  // namespace remap
