// A converter as statements that every language can write: one formula for C99, Python, JavaScript, shaders
// and MaterialX.
#pragma once

#include <string>
#include <vector>

#include "converter/converter_data.hpp"

namespace remap {

enum class Op { kNumber, kName, kAdd, kSubtract, kMultiply, kDivide, kMin, kMax, kRoot, kLargest };

// A number, a name, an operation on two terms, the square root of one, or the largest channel of a color.
struct Expression {
  Op op = Op::kNumber;
  float number = 0.0f;
  std::string name;
  std::vector<Expression> terms;
};

// A value with a name. Of colors each channel by itself.
struct Statement {
  std::string name;
  bool is_color = false;
  Expression value;
};

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

// How a language writes an expression.
struct Notation {
  std::string (*number)(float) = nullptr;
  std::string least, most, root;  // functions
  std::string (*largest)(const std::string& color) = nullptr;
  std::string channel = {};  // behind the names of colors
};
// `colors`: the names that are colors.
std::string text_of(const Expression& expression, const Notation& notation,
                    const std::vector<std::string>& colors = {});

}  // namespace remap
