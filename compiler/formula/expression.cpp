#include "formula/expression.hpp"

#include <algorithm>
#include <cmath>

namespace remap {
namespace {

// Returns how strongly an operation binds, which decides where parentheses are needed.
int rank_of(const Expression& expression) {
  switch (expression.op) {
    case Op::kAdd:
    case Op::kSubtract:
      return 1;
    case Op::kMultiply:
    case Op::kDivide:
      return 2;
    case Op::kNumber:
      return std::signbit(expression.number) ? 2 : 3;
    default:
      return 3;
  }
}

}  // namespace

Expression number(float value) { return {Op::kNumber, value, "", {}}; }
Expression named(const std::string& name) { return {Op::kName, 0.0f, name, {}}; }
Expression joined(Op op, Expression a, Expression b) { return {op, 0.0f, "", {std::move(a), std::move(b)}}; }
Expression call(const std::string& function, std::vector<Expression> terms) {
  return {Op::kCall, 0.0f, function, std::move(terms)};
}

std::string text_of(const Expression& expression, const Notation& notation,
                    const std::vector<std::string>& colors) {
  const auto inner = [&](std::size_t term, int rank) {
    const std::string text = text_of(expression.terms[term], notation, colors);
    return rank_of(expression.terms[term]) < rank ? "(" + text + ")" : text;
  };
  switch (expression.op) {
    case Op::kNumber:
      return notation.number(expression.number);
    case Op::kName:
      return expression.name +
             (std::ranges::find(colors, expression.name) == colors.end() ? "" : notation.channel);
    case Op::kAdd:
      return inner(0, 1) + " + " + inner(1, 2);
    case Op::kSubtract:
      return inner(0, 1) + " - " + inner(1, 2);
    case Op::kMultiply:
      return inner(0, 2) + " * " + inner(1, 3);
    case Op::kDivide:
      return inner(0, 2) + " / " + inner(1, 3);
    case Op::kCall:
      break;
  }
  std::vector<std::string> terms;
  for (const Expression& term : expression.terms)
    terms.push_back(
        text_of(term, notation, expression.name == "largest" ? std::vector<std::string>() : colors));
  return notation.call(expression.name, terms);
}

std::function<std::string(const std::string&, const std::vector<std::string>&)> calls_by(
    std::vector<std::pair<std::string, std::string>> patterns) {
  return
      [patterns = std::move(patterns)](const std::string& function, const std::vector<std::string>& terms) {
        const auto known = std::ranges::find(patterns, function, &std::pair<std::string, std::string>::first);
        const std::string& pattern = known == patterns.end() ? function : known->second;
        std::string text;
        if (pattern.find('$') == std::string::npos) {
          text = pattern + "(";
          for (std::size_t i = 0; i < terms.size(); ++i) text += (i == 0 ? "" : ", ") + terms[i];
          return text + ")";
        }
        for (std::size_t i = 0; i < pattern.size(); ++i)
          text += pattern[i] == '$' ? terms.at(static_cast<std::size_t>(pattern[++i] - '1'))
                                    : std::string(1, pattern[i]);
        return text;
      };
}

}  // namespace remap
