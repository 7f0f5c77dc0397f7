// This file writes a converter as statements, from which C99, Python, JavaScript, shaders, MaterialX and C++
// are made.
#pragma once

#include <string>
#include <vector>

#include "converter/converter_data.hpp"
#include "formula/expression.hpp"

namespace remap {

// Returns statements that compute `width_out` and `specular_out` from `width` (a number) and `specular` (a
// color), in the units of the models. Statements that nothing uses are left out. Beyond the measured range
// they do what generated headers do, but they do not look for NaN.
std::vector<Statement> formula_of(const ConverterData& converter);

// Return the formula of alpha for a model's own width parameter, and its inverse
// (runtime/include/remap/converter.hpp).
Expression alpha_of(RoughnessEncoding convention, const std::string& parameter);
Expression native_of(RoughnessEncoding convention, const std::string& parameter);

// Returns a factor of a form (converter/compact_form.hpp) as an expression of `alpha` and `t`. The operations
// have the same order in every evaluator.
Expression factor_expression(const FactorTerms& factor, const std::string& alpha, const std::string& t);

}  // namespace remap
