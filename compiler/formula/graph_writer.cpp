#include <algorithm>

#include "core/number_text.hpp"
#include "formula/expression.hpp"

namespace remap {

std::string material_x_type(ValueType type) {
  switch (type) {
    case ValueType::kNumber:
      return "float";
    case ValueType::kColor:
      return "color3";
    case ValueType::kInteger:
      return "integer";
    case ValueType::kBoolean:
      break;
  }
  return "boolean";
}

void GraphWriter::write(const Statement& statement) {
  const bool is_output = statement.name.ends_with("_out");
  const std::string name =
      is_output ? statement.name.substr(0, statement.name.size() - 4) + "_value" : statement.name;
  // MaterialX cannot convert a number to an integer, but it can choose between two integers.
  const bool is_choice = statement.value.op == Op::kCall && statement.value.name.starts_with("if_");
  Term term = is_choice && statement.type == ValueType::kInteger
                  ? choice_of(statement.value, statement.type, name)
                  : as(statement.type, term_of(statement.value, name));
  if (!is_output) {
    locals_[statement.name] = std::move(term);
    return;
  }
  // An output of a graph must refer to a node. So a constant or an input gets a node.
  if (!term.attribute.starts_with("nodename")) {
    const bool is_value = term.attribute.starts_with("value");
    term = node(is_value ? "constant" : "dot", term.type, {{is_value ? "value" : "in", term}}, name);
  }
  outputs_ += "    <output name=\"" + statement.name + "\" type=\"" + material_x_type(term.type) + "\" " +
              term.attribute + " />\n";
}

GraphWriter::Term GraphWriter::term_of(const Expression& expression, const std::string& name) {
  switch (expression.op) {
    case Op::kNumber:
      return {ValueType::kNumber, "value=\"" + number_text(decimal_value(expression.number)) + "\""};
    case Op::kName:
      if (const auto input = inputs_.find(expression.name); input != inputs_.end()) {
        // In `source.NAME`, only NAME is the name in the graph.
        const std::string plain = expression.name.substr(expression.name.rfind('.') + 1);
        return {input->second, "interfacename=\"" + plain + "\""};
      }
      return locals_.at(expression.name);
    case Op::kCall:
      return call_of(expression, name);
    default:
      break;
  }
  static const std::map<Op, const char*> kNodes = {
      {Op::kAdd, "add"}, {Op::kSubtract, "subtract"}, {Op::kMultiply, "multiply"}, {Op::kDivide, "divide"}};
  Term a = term_of(expression.terms[0], ""), b = term_of(expression.terms[1], "");
  return binary(kNodes.at(expression.op), std::move(a), std::move(b), name);
}

GraphWriter::Term GraphWriter::binary(const std::string& kind, Term a, Term b, const std::string& name) {
  // MaterialX allows a color and a float as inputs of a node only if the color is the first input.
  if (a.type != ValueType::kColor && b.type == ValueType::kColor) {
    if (kind == "subtract" || kind == "divide" || kind == "power")
      a = as(ValueType::kColor, a);
    else
      std::swap(a, b);
  }
  return node(kind, a.type, {{"in1", a}, {"in2", b}}, name);
}

GraphWriter::Term GraphWriter::call_of(const Expression& expression, const std::string& name) {
  const std::string& function = expression.name;
  if (function.starts_with("if_")) return choice_of(expression, std::nullopt, name);
  std::vector<Term> terms;
  for (const Expression& term : expression.terms) terms.push_back(term_of(term, ""));
  if (const auto own = std::ranges::find(functions_, function, &FormulaFunction::name);
      own != functions_.end())
    return function_of(*own, terms, name);
  if (function == "min" || function == "max") return binary(function, terms[0], terms[1], name);
  if (function == "pow") return binary("power", terms[0], terms[1], name);
  if (function == "square")
    return node("multiply", terms[0].type, {{"in1", terms[0]}, {"in2", terms[0]}}, name);
  if (function == "color") return as(ValueType::kColor, terms[0]);
  if (function == "mix") {
    const bool is_color = terms[0].type == ValueType::kColor || terms[1].type == ValueType::kColor ||
                          terms[2].type == ValueType::kColor;
    const ValueType type = is_color ? ValueType::kColor : ValueType::kNumber;
    return node("mix", type, {{"fg", as(type, terms[1])}, {"bg", as(type, terms[0])}, {"mix", terms[2]}},
                name);
  }
  if (function == "channel")
    return node("extract", ValueType::kNumber,
                {{"in", terms[0]}, {"index", as(ValueType::kInteger, terms[1])}}, name);
  if (function == "largest") {
    std::vector<Term> channels;
    for (const char* index : {"0", "1", "2"})
      channels.push_back(node(
          "extract", ValueType::kNumber,
          {{"in", terms[0]}, {"index", {ValueType::kInteger, std::string("value=\"") + index + "\""}}}, ""));
    return binary("max", binary("max", channels[0], channels[1], ""), channels[2], name);
  }
  // MaterialX has no square root of a color.
  if (function == "sqrt" && terms[0].type == ValueType::kColor)
    return node("power", ValueType::kColor,
                {{"in1", terms[0]}, {"in2", {ValueType::kNumber, "value=\"0.5\""}}}, name);
  return node(function, terms[0].type, {{"in", terms[0]}}, name);
}

GraphWriter::Term GraphWriter::choice_of(const Expression& expression, std::optional<ValueType> wanted,
                                         const std::string& name) {
  std::vector<Term> terms;
  for (const Expression& term : expression.terms) terms.push_back(term_of(term, ""));
  const bool is_color = terms[2].type == ValueType::kColor || terms[3].type == ValueType::kColor;
  const ValueType type = wanted.value_or(is_color ? ValueType::kColor : ValueType::kNumber);
  return node(expression.name == "if_equal" ? "ifequal" : "ifgreater", type,
              {{"value1", terms[0]},
               {"value2", as(terms[0].type, terms[1])},
               {"in1", as(type, terms[2])},
               {"in2", as(type, terms[3])}},
              name);
}

GraphWriter::Term GraphWriter::function_of(const FormulaFunction& function, const std::vector<Term>& terms,
                                           const std::string& name) {
  std::string id = "remap_" + function.name + "_", inputs;
  std::map<std::string, ValueType> types;
  std::vector<std::pair<std::string, Term>> given;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const std::string& parameter = function.parameters[i];
    id += terms[i].type == ValueType::kColor ? 'c' : 'f';
    types[parameter] = terms[i].type;
    inputs += "    <input name=\"" + parameter + "\" type=\"" + material_x_type(terms[i].type) +
              "\" value=\"" + (terms[i].type == ValueType::kColor ? "0, 0, 0" : "0") + "\" />\n";
    given.emplace_back(parameter, terms[i]);
  }
  if (!definitions_->contains(id)) {
    GraphWriter inner(std::move(types), functions_, definitions_);
    Term result = inner.term_of(function.body, "");
    (*definitions_)[id] = {
        result.type, "  <nodedef name=\"ND_" + id + "\" node=\"" + id + "\" nodegroup=\"math\">\n" + inputs +
                         "    <output name=\"out\" type=\"" + material_x_type(result.type) +
                         "\" />\n  </nodedef>\n  <nodegraph name=\"NG_" + id + "\" nodedef=\"ND_" + id +
                         "\">\n" + inner.nodes() + "    <output name=\"out\" type=\"" +
                         material_x_type(result.type) + "\" " + result.attribute + " />\n  </nodegraph>\n"};
  }
  return node(id, definitions_->at(id).type, given, name);
}

GraphWriter::Term GraphWriter::as(ValueType type, const Term& term) {
  if (term.type == type) return term;
  if (!term.attribute.starts_with("value")) return node("convert", type, {{"in", term}}, "");
  const std::string value = term.attribute.substr(7, term.attribute.size() - 8);
  if (type == ValueType::kColor) return {type, "value=\"" + value + ", " + value + ", " + value + "\""};
  if (type == ValueType::kBoolean) return {type, value == "0" ? "value=\"false\"" : "value=\"true\""};
  return {type, term.attribute};
}

GraphWriter::Term GraphWriter::node(const std::string& kind, ValueType type,
                                    const std::vector<std::pair<std::string, Term>>& inputs,
                                    const std::string& name) {
  std::string text = " type=\"" + material_x_type(type) + "\">\n";
  for (const auto& [input, term] : inputs)
    text += "      <input name=\"" + input + "\" type=\"" + material_x_type(term.type) + "\" " +
            term.attribute + " />\n";
  text += "    </" + kind + ">\n";
  const auto known = made_.find(kind + text);
  if (known != made_.end()) return known->second;
  const std::string id = name.empty() ? "n" + std::to_string(++numbered_) : name;
  nodes_ += "    <" + kind + " name=\"" + id + "\"" + text;
  return made_.emplace(kind + text, Term{type, "nodename=\"" + id + "\""}).first->second;
}

}  // namespace remap
