#include "materials/description.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "formula/text_template.hpp"
#include "remap/error.hpp"
#include "remap/model.hpp"

namespace remap {
namespace {

// These are the numbers of terms of functions that every language has.
constexpr NamedValues<std::size_t, 9> kBuiltIns = {{{2, "min"},
                                                    {2, "max"},
                                                    {3, "mix"},
                                                    {2, "pow"},
                                                    {1, "sqrt"},
                                                    {1, "exp"},
                                                    {1, "largest"},
                                                    {2, "channel"},
                                                    {1, "color"}}};

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t\r") - first + 1));
}

bool begins_with_operator(const std::string& words) {
  return std::string_view("+-*/?:").find(words.front()) != std::string_view::npos;
}

// Calls `parse` with each statement of a file and the comment above it. If a line begins with an operator, it
// continues the statement before it. If a blank line follows the first comment, `head` receives this comment.
// If `parse` throws, adds the file and the line to the message.
void for_each_statement(std::string_view text, const std::string& name, std::string* head,
                        const auto& parse) {
  std::istringstream stream{std::string(text)};
  std::string statement, comment, next_comment;
  std::size_t first_line = 0, number = 0;
  const auto finish = [&] {
    if (first_line == 0) return;
    try {
      parse(statement, comment);
    } catch (const Error& error) {
      throw input_error(name + ":" + std::to_string(first_line) + ": " + error.what());
    }
  };
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const std::string words = trimmed(line);
    if (words.starts_with("#")) {
      next_comment += (next_comment.empty() ? "" : "\n") + trimmed(words.substr(1));
    } else if (words.empty()) {
      if (head && first_line == 0 && head->empty()) *head = next_comment;
      next_comment.clear();
    } else if (first_line != 0 && begins_with_operator(words)) {
      statement += " " + words;
    } else {
      finish();
      first_line = number;
      statement = words;
      comment = std::exchange(next_comment, "");
    }
  }
  finish();
}

class ExpressionParser {
 public:
  ExpressionParser(std::string_view text, const std::vector<FormulaFunction>& functions)
      : text_(text), functions_(functions) {}

  Expression whole() {
    Expression value = choice();
    if (peek() != '\0') fail("'" + std::string(text_.substr(at_)) + "' is left over");
    return value;
  }

 private:
  [[noreturn]] static void fail(const std::string& what) { throw input_error(what); }

  char peek() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(std::string_view word) {
    peek();
    if (!text_.substr(at_).starts_with(word)) return false;
    at_ += word.size();
    return true;
  }
  void require(std::string_view word) {
    if (!take(word))
      fail("'" + std::string(word) + "' is missing before '" + std::string(text_.substr(at_)) + "'");
  }

  Expression choice() {
    Expression a = sum();
    const bool is_greater = take(">");
    if (!is_greater && !take("==")) return a;
    Expression b = sum();
    require("?");
    Expression yes = choice();
    require(":");
    return call(is_greater ? "if_greater" : "if_equal",
                {std::move(a), std::move(b), std::move(yes), choice()});
  }

  Expression sum() {
    Expression value = product();
    for (;;) {
      if (take("+"))
        value = joined(Op::kAdd, std::move(value), product());
      else if (take("-"))
        value = joined(Op::kSubtract, std::move(value), product());
      else
        return value;
    }
  }

  Expression product() {
    Expression value = power();
    for (;;) {
      if (take("*"))
        value = joined(Op::kMultiply, std::move(value), power());
      else if (take("/"))
        value = joined(Op::kDivide, std::move(value), power());
      else
        return value;
    }
  }

  Expression power() {
    Expression value = primary();
    if (!take("^")) return value;
    if (take("2")) return call("square", {std::move(value)});
    if (take("3")) return joined(Op::kMultiply, value, call("square", {value}));
    if (take("4")) return call("square", {call("square", {std::move(value)})});
    fail("the exponent of ^ is not 2, 3 or 4 (use pow)");
  }

  Expression primary() {
    const char next = peek();
    if (take("(")) {
      Expression value = choice();
      require(")");
      return value;
    }
    if (std::isdigit(static_cast<unsigned char>(next)) || next == '.' || next == '-') return constant();
    return name_or_call();
  }

  Expression constant() {
    std::size_t length = 1;
    while (at_ + length < text_.size() &&
           (std::isdigit(static_cast<unsigned char>(text_[at_ + length])) || text_[at_ + length] == '.'))
      ++length;
    const std::optional<double> value = parse_number(text_.substr(at_, length));
    if (!value) fail("'" + std::string(text_.substr(at_, length)) + "' is not a number");
    at_ += length;
    return number(static_cast<float>(*value));
  }

  Expression name_or_call() {
    const std::size_t start = at_;
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_' || text_[at_] == '.'))
      ++at_;
    const std::string name(text_.substr(start, at_ - start));
    if (name.empty()) fail("a value is missing before '" + std::string(text_.substr(at_)) + "'");
    if (!take("(")) return named(name);
    std::vector<Expression> terms;
    do terms.push_back(choice());
    while (take(","));
    require(")");
    require_terms(name, terms.size());
    return call(name, std::move(terms));
  }

  void require_terms(const std::string& name, std::size_t count) const {
    std::size_t expected = 0;
    if (const std::optional<std::size_t> known = value_named(kBuiltIns, name))
      expected = *known;
    else if (const auto own = std::ranges::find(functions_, name, &FormulaFunction::name);
             own != functions_.end())
      expected = own->parameters.size();
    else
      fail("unknown function '" + name + "'");
    if (count != expected)
      fail(name + " has " + std::to_string(count) + " terms instead of " + std::to_string(expected));
  }

  std::string_view text_;
  const std::vector<FormulaFunction>& functions_;
  std::size_t at_ = 0;
};

// Returns the expression with every call of a function replaced by its body.
Expression inlined(const Expression& expression, const std::vector<FormulaFunction>& functions) {
  Expression result = expression;
  for (Expression& term : result.terms) term = inlined(term, functions);
  if (expression.op != Op::kCall) return result;
  const auto function = std::ranges::find(functions, expression.name, &FormulaFunction::name);
  if (function == functions.end()) return result;
  const auto replaced = [&](const auto& self, const Expression& part) -> Expression {
    if (part.op == Op::kName) {
      const auto parameter = std::ranges::find(function->parameters, part.name);
      return result.terms.at(static_cast<std::size_t>(parameter - function->parameters.begin()));
    }
    Expression copy = part;
    for (Expression& term : copy.terms) term = self(self, term);
    return copy;
  };
  return inlined(replaced(replaced, function->body), functions);
}

// Returns the type of an expression. `names` holds the types of its names.
ValueType type_of(const Expression& expression, const std::map<std::string, ValueType>& names) {
  if (expression.op == Op::kNumber) return ValueType::kNumber;
  if (expression.op == Op::kName) {
    const auto known = names.find(expression.name);
    if (known == names.end()) throw input_error("unknown name '" + expression.name + "'");
    return known->second;
  }
  std::vector<ValueType> types;
  for (const Expression& term : expression.terms) types.push_back(type_of(term, names));
  const auto is_color = [](ValueType type) { return type == ValueType::kColor; };
  const bool is_call = expression.op == Op::kCall;
  if (is_call && (expression.name == "largest" || expression.name == "channel")) {
    if (!is_color(types[0])) throw input_error(expression.name + " of a value that is not a color");
    return ValueType::kNumber;
  }
  if (is_call && expression.name == "color") return ValueType::kColor;
  if (is_call && expression.name.starts_with("if_") && (is_color(types[0]) || is_color(types[1])))
    throw input_error("colors cannot be compared (compare a channel, or the largest)");
  return std::ranges::any_of(types, is_color) ? ValueType::kColor : ValueType::kNumber;
}

std::pair<std::string, std::string> sides_of(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals + 1 == text.size()) throw input_error("'=' is missing");
  return {trimmed(text.substr(0, equals)), trimmed(text.substr(equals + 1))};
}

void collect_names(const Expression& expression, std::vector<std::string>& names) {
  if (expression.op == Op::kName) names.push_back(expression.name);
  for (const Expression& term : expression.terms) collect_names(term, names);
}

MaterialInput input_of(const std::string& text) {
  std::istringstream words(text);
  MaterialInput input;
  std::string word;
  words >> input.name;
  while (words >> word) {
    if (word == "integer") {
      input.type = ValueType::kInteger;
    } else if (word == "true" || word == "false") {
      input.type = ValueType::kBoolean;
      input.value.push_back(word == "true" ? 1.0f : 0.0f);
    } else {
      const std::optional<double> value = parse_number(word);
      if (!value) throw input_error("'" + word + "' is not a number");
      input.value.push_back(static_cast<float>(*value));
    }
  }
  if (input.value.size() == 3) input.type = ValueType::kColor;
  if (input.value.size() != 1 && input.value.size() != 3)
    throw input_error("the default of " + input.name + " is neither a number nor a color");
  return input;
}

MaterialLibrary load_library() {
  MaterialLibrary library;
  const auto file = [](const std::string& name) { return code_file(name); };
  library.models = parse_models(file("models"), "models.txt");
  library.functions = parse_functions(file("functions"), "functions.txt");
  const auto model = [&](const std::string& id) -> const MaterialModel& {
    return *std::ranges::find(library.models, id, &MaterialModel::id);
  };
  // The translations that people need most come first.
  constexpr std::array<std::array<const char*, 3>, 9> kShipped = {
      {{"UsdPreviewSurface", "open_pbr_surface", ""},
       {"principled", "open_pbr_surface", ""},
       {"open_pbr_surface", "UsdPreviewSurface", ""},
       {"open_pbr_surface", "UsdPreviewSurface", "_specular"},
       {"open_pbr_surface", "gltf_pbr", ""},
       {"standard_surface", "open_pbr_surface", ""},
       {"open_pbr_surface", "standard_surface", ""},
       {"gltf_pbr", "open_pbr_surface", ""},
       {"gltf_pbr", "gltf_pbr", "_core"}}};
  for (const auto& [from, to, variant] : kShipped) {
    const std::string name = std::string(from) + "_to_" + to + variant;
    library.translations.push_back(
        parse_translation(file(name), name + ".txt", model(from), model(to), library.functions));
    library.translations.back().variant = variant;
  }
  return library;
}

}  // namespace

const MaterialInput* MaterialModel::find(std::string_view name) const {
  const auto found = std::ranges::find(inputs, name, &MaterialInput::name);
  return found == inputs.end() ? nullptr : &*found;
}

std::vector<std::string> Translation::ignored() const {
  std::vector<std::string> used, unused;
  for (const Statement& line : lines) collect_names(line.value, used);
  for (const MaterialInput& input : from->inputs)
    if (std::ranges::find(used, "source." + input.name) == used.end()) unused.push_back(input.name);
  return unused;
}

std::vector<MaterialModel> parse_models(std::string_view text, const std::string& name) {
  std::vector<MaterialModel> models;
  for_each_statement(text, name, nullptr, [&](const std::string& line, const std::string&) {
    if (line.starts_with("model ")) {
      const std::string words = trimmed(line.substr(6));
      const auto blank = words.find(' ');
      if (blank == std::string::npos) throw input_error("the title of the model is missing");
      models.push_back({words.substr(0, blank), trimmed(words.substr(blank)), {}});
    } else if (models.empty()) {
      throw input_error("an input stands before the first model");
    } else {
      models.back().inputs.push_back(input_of(line));
    }
  });
  return models;
}

std::vector<FormulaFunction> parse_functions(std::string_view text, const std::string& name) {
  std::vector<FormulaFunction> functions;
  std::string head;
  for_each_statement(text, name, &head, [&](const std::string& line, const std::string& comment) {
    const auto [left, right] = sides_of(line);
    const auto open = left.find('(');
    if (open == std::string::npos || !left.ends_with(")"))
      throw input_error("this is not a function: " + left);
    FormulaFunction function{trimmed(left.substr(0, open)), {}, {}, comment};
    std::istringstream parameters(left.substr(open + 1, left.size() - open - 2));
    for (std::string parameter; std::getline(parameters, parameter, ',');)
      function.parameters.push_back(trimmed(parameter));
    function.body = ExpressionParser(right, functions).whole();
    std::vector<std::string> names;
    collect_names(function.body, names);
    for (const std::string& used : names)
      if (std::ranges::find(function.parameters, used) == function.parameters.end())
        throw input_error("unknown name '" + used + "'");
    functions.push_back(std::move(function));
  });
  return functions;
}

Translation parse_translation(std::string_view text, const std::string& name, const MaterialModel& from,
                              const MaterialModel& to, const std::vector<FormulaFunction>& functions) {
  Translation translation{&from, &to, "", "", {}};
  std::map<std::string, ValueType> names;
  for (const MaterialInput& input : from.inputs) names["source." + input.name] = input.type;
  for_each_statement(text, name, &translation.comment,
                     [&](const std::string& line, const std::string& comment) {
                       const auto [left, right] = sides_of(line);
                       Expression value = ExpressionParser(right, functions).whole();
                       ValueType type = type_of(inlined(value, functions), names);
                       if (left.starts_with("target.")) {
                         const MaterialInput* input = to.find(left.substr(7));
                         if (!input)
                           throw input_error(to.id + " does not have the input '" + left.substr(7) + "'");
                         if (type == ValueType::kColor && input->type != ValueType::kColor)
                           throw input_error(left + " is a number, but the value is a color");
                         type = input->type;
                       } else if (from.find(left) || to.find(left)) {
                         throw input_error("'" + left + "' is the name of an input (choose another)");
                       }
                       if (!names.emplace(left, type).second)
                         throw input_error("'" + left + "' has a value already");
                       translation.lines.push_back({left, type, std::move(value), comment});
                     });
  return translation;
}

const MaterialLibrary& material_library() {
  static const MaterialLibrary library = load_library();
  return library;
}

}  // namespace remap
