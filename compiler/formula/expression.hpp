// Formulas as statements that every language can write: of converters (emit/converter_formula.hpp), and of
// whole materials (materials/description.hpp).
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace remap {

enum class Op { kNumber, kName, kAdd, kSubtract, kMultiply, kDivide, kCall };

// A number, a name, an operation on two terms, or a call of the function `name`. Functions of formulas: min
// and max of two terms, sqrt, and largest (the largest channel of a color).
struct Expression {
  Op op = Op::kNumber;
  float number = 0.0f;
  std::string name;
  std::vector<Expression> terms;
};
Expression number(float value);
Expression named(const std::string& name);
Expression joined(Op op, Expression a, Expression b);
Expression call(const std::string& function, std::vector<Expression> terms);

enum class ValueType { kNumber, kColor, kInteger, kBoolean };

// A value with a name. Of colors each channel by itself.
struct Statement {
  std::string name;
  ValueType type = ValueType::kNumber;
  Expression value;
};

// A function of several formulas: an expression of its parameters.
struct FormulaFunction {
  std::string name;
  std::vector<std::string> parameters;
  Expression body;
  std::string comment;
};

// How a language writes an expression.
struct Notation {
  std::string (*number)(float) = nullptr;
  // A call from the texts of its terms.
  std::function<std::string(const std::string& function, const std::vector<std::string>& terms)> call;
  std::string channel = {};  // behind the names of colors
};
// Writes calls by patterns: `$1` is the first term. A function without a pattern, or whose pattern has no
// term, is written as `name(terms)`.
std::function<std::string(const std::string&, const std::vector<std::string>&)> calls_by(
    std::vector<std::pair<std::string, std::string>> patterns);

// `colors`: the names that are colors.
std::string text_of(const Expression& expression, const Notation& notation,
                    const std::vector<std::string>& colors = {});

}  // namespace remap
