// This file writes a converter as statements that every language has: one formula for C99, Python,
// JavaScript, shaders and MaterialX.
#pragma once

#include <string>
#include <vector>

#include "converter/converter_data.hpp"

namespace remap {

enum class Op { kNumber, kName, kAdd, kSubtract, kMultiply, kDivide, kMin, kMax, kRoot, kLargest };

// An Expression is a number, a name, a binary operation, a root, or the largest channel of a color.
struct Expression {
  Op op = Op::kNumber;
  float number = 0.0f;
  std::string name;
  std::vector<Expression> terms;
};

// A Statement is a value with a name. Colors are computed channel by channel.
struct Statement {
  std::string name;
  bool is_color = false;
  Expression value;
};

// Returns the statements, in order, from the inputs `width` (a number) and `specular` (a color) to
// `width_out` and `specular_out`, in the units of the models. It drops unused statements. Inputs beyond the
// measured range are clamped as in headers. NaN is not detected.
std::vector<Statement> formula_of(const ConverterData& converter);

// These return alpha for a model's own width parameter, and the parameter for alpha
// (runtime/include/remap/converter.hpp).
Expression alpha_of(RoughnessEncoding convention, const std::string& parameter);
Expression native_of(RoughnessEncoding convention, const std::string& parameter);

// Returns the factors of a form (converter/compact_form.hpp) as expressions of `alpha` and `t`. Every
// evaluator has this order of operations.
Expression factor_expression(const FactorTerms& factor, const std::string& alpha, const std::string& t);

// A Notation is the way in which a language writes an expression.
struct Notation {
  std::string (*number)(float) = nullptr;
  std::string least, most, root;  // names of functions
  std::string (*largest)(const std::string& color) = nullptr;
  std::string channel = {};  // suffix of the names of colors
};
// Returns the text of an expression. `colors` are the names that are colors.
std::string text_of(const Expression& expression, const Notation& notation,
                    const std::vector<std::string>& colors = {});

}  // namespace remap
