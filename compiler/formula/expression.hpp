// This file holds formulas as statements, which can be written in every language. emit/emit.hpp
// makes the formulas of converters, materials/description.hpp those of whole materials.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace remap {

enum class Op { kNumber, kName, kAdd, kSubtract, kMultiply, kDivide, kCall };

// An Expression is a number, a name, an operation on two terms, or a call of the function `name`. Converters
// call min and max of two terms, sqrt, and largest, which is the largest channel of a color.
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

// A Statement gives a value a name. If the value is a color, each channel is computed separately.
struct Statement {
  std::string name;
  ValueType type = ValueType::kNumber;
  Expression value;
  std::string comment = {};  // the comment above it
};

// A FormulaFunction is an expression of its parameters that several formulas can call.
struct FormulaFunction {
  std::string name;
  std::vector<std::string> parameters;
  Expression body;
  std::string comment;
};

// A Notation decides how a language writes an expression.
struct Notation {
  std::string (*number)(float) = nullptr;
  // Returns the text of a call from the texts of its terms.
  std::function<std::string(const std::string& function, const std::vector<std::string>& terms)> call;
  std::string channel = {};  // what follows the name of a color, such as `[c]`
};
// Returns a Notation::call that fills patterns: `$1` is the first term. If a function has no pattern, or its
// pattern has no `$`, the call is written as `name(terms)`.
std::function<std::string(const std::string&, const std::vector<std::string>&)> calls_by(
    std::vector<std::pair<std::string, std::string>> patterns);

// Returns the text of an expression. `colors` lists the names whose values are colors.
std::string text_of(const Expression& expression, const Notation& notation,
                    const std::vector<std::string>& colors = {});

}  // namespace remap
