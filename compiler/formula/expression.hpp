// This file holds formulas as statements, which can be written in every language, and writes them as a node
// graph of MaterialX. emit/languages.cpp makes the formulas of converters, materials/description.hpp those of
// whole materials.
#pragma once

#include <functional>
#include <map>
#include <optional>
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

// Returns the name of the type in MaterialX, such as `color3`.
std::string material_x_type(ValueType type);

// A GraphFunction is a function as a node definition with its graph. Its terms have certain types.
struct GraphFunction {
  ValueType type = ValueType::kNumber;
  std::string text;
};

// A GraphWriter writes each operation once: equal operations on equal terms share a node. A statement whose
// name ends in `_out` becomes an output of the graph. The nodes exist in MaterialX 1.38 and later.
class GraphWriter {
 public:
  // `inputs` holds the names and types of the graph's inputs. A call of one of `functions` becomes a node of
  // the category `remap_NAME_TYPES`. The definition of this node is added to `definitions` under the same
  // name.
  explicit GraphWriter(std::map<std::string, ValueType> inputs,
                       const std::vector<FormulaFunction>& functions = {},
                       std::map<std::string, GraphFunction>* definitions = nullptr)
      : inputs_(std::move(inputs)), functions_(functions), definitions_(definitions) {}

  void write(const Statement& statement);

  // Return the elements of the graph, indented by four spaces.
  const std::string& nodes() const { return nodes_; }
  const std::string& outputs() const { return outputs_; }
  std::size_t count() const { return made_.size(); }

 private:
  // A Term is an attribute that connects an input to its value: `nodename="..."`.
  struct Term {
    ValueType type;
    std::string attribute;
  };

  Term term_of(const Expression& expression, const std::string& name);
  Term call_of(const Expression& expression, const std::string& name);
  Term choice_of(const Expression& expression, std::optional<ValueType> wanted, const std::string& name);
  Term function_of(const FormulaFunction& function, const std::vector<Term>& terms, const std::string& name);
  Term node(const std::string& kind, ValueType type, const std::vector<std::pair<std::string, Term>>& inputs,
            const std::string& name);
  Term binary(const std::string& kind, Term a, Term b, const std::string& name);
  Term as(ValueType type, const Term& term);

  std::map<std::string, ValueType> inputs_;
  std::vector<FormulaFunction> functions_;
  std::map<std::string, GraphFunction>* definitions_;
  std::map<std::string, Term> locals_;
  std::map<std::string, Term> made_;  // keyed by the text of the node without its name
  std::string nodes_, outputs_;
  int numbered_ = 0;
};

}  // namespace remap
