// This file writes statements as a node graph of MaterialX.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "formula/expression.hpp"

namespace remap {

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
