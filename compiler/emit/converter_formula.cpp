#include "emit/converter_formula.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace remap {
namespace {

bool is_number(const Expression& expression, float value) {
  return expression.op == Op::kNumber && expression.number == value;
}

// Returns the first factor of a product. If the expression is not a product, returns the expression.
Expression& first_factor(Expression& expression) {
  return expression.op == Op::kMultiply ? first_factor(expression.terms[0]) : expression;
}

// Adds two expressions. a + -b is written as a - b.
Expression operator+(Expression a, Expression b) {
  if (is_number(b, 0.0f)) return a;
  if (Expression& factor = first_factor(b); factor.op == Op::kNumber && std::signbit(factor.number)) {
    factor.number = -factor.number;
    return joined(Op::kSubtract, std::move(a), std::move(b));
  }
  return joined(Op::kAdd, std::move(a), std::move(b));
}
Expression operator-(Expression a, Expression b) { return joined(Op::kSubtract, std::move(a), std::move(b)); }
Expression operator*(Expression a, Expression b) {
  if (is_number(b, 1.0f)) return a;
  return joined(Op::kMultiply, std::move(a), std::move(b));
}
Expression operator/(Expression a, Expression b) { return joined(Op::kDivide, std::move(a), std::move(b)); }
Expression least(Expression a, Expression b) { return call("min", {std::move(a), std::move(b)}); }
Expression most(Expression a, Expression b) { return call("max", {std::move(a), std::move(b)}); }
Expression root(Expression a) { return call("sqrt", {std::move(a)}); }

Expression sum_of_powers(const std::vector<float>& terms, const Expression& x) {
  Expression sum = number(terms.back());
  for (std::size_t i = terms.size() - 1; i-- > 0;) sum = std::move(sum) * x + number(terms[i]);
  return sum;
}

bool uses(const Expression& expression, const std::string& wanted) {
  return (expression.op == Op::kName && expression.name == wanted) ||
         std::ranges::any_of(expression.terms, [&](const Expression& term) { return uses(term, wanted); });
}

// Removes statements that no other statement uses.
std::vector<Statement> used(std::vector<Statement> statements) {
  for (std::size_t i = statements.size(); i-- > 0;) {
    const std::string wanted = statements[i].name;
    const bool is_output = wanted.ends_with("_out");
    if (!is_output && std::none_of(statements.begin() + static_cast<std::ptrdiff_t>(i), statements.end(),
                                   [&](const Statement& later) { return uses(later.value, wanted); }))
      statements.erase(statements.begin() + static_cast<std::ptrdiff_t>(i));
  }
  return statements;
}

}  // namespace

Expression alpha_of(RoughnessEncoding convention, const std::string& parameter) {
  const Expression own = named(parameter);
  switch (convention) {
    case RoughnessEncoding::kAlpha:
      break;
    case RoughnessEncoding::kRoughness:
      return own * own;
    case RoughnessEncoding::kExponent:
      return root(number(2.0f) / (own + number(2.0f)));
    case RoughnessEncoding::kGlossiness:
      return (number(1.0f) - own) * (number(1.0f) - own);
    case RoughnessEncoding::kSquared:
      return root(own);
  }
  return own;
}

Expression native_of(RoughnessEncoding convention, const std::string& parameter) {
  const Expression alpha = named(parameter);
  switch (convention) {
    case RoughnessEncoding::kAlpha:
      break;
    case RoughnessEncoding::kRoughness:
      return root(alpha);
    case RoughnessEncoding::kExponent:
      return number(2.0f) / (alpha * alpha) - number(2.0f);
    case RoughnessEncoding::kGlossiness:
      return number(1.0f) - root(alpha);
    case RoughnessEncoding::kSquared:
      return alpha * alpha;
  }
  return alpha;
}

Expression factor_expression(const FactorTerms& factor, const std::string& alpha, const std::string& t) {
  Expression sum = sum_of_powers(factor.back(), named(alpha));
  for (std::size_t j = factor.size() - 1; j-- > 0;)
    sum = std::move(sum) * named(t) + sum_of_powers(factor[j], named(alpha));
  return sum;
}

std::vector<Statement> formula_of(const ConverterData& converter) {
  const CompactForm& form = converter.form;
  const ConverterInfo& info = converter.info;
  const FormEnds ends = ends_of(info.source.roughness, info.target.roughness, info.roughness);
  const Expression alpha = named("alpha"), inside = named("inside"), top = named("top"),
                   wanted = named("wanted"), held = named("held"), s = named("s"), pole = number(form.pole),
                   specular_min = number(static_cast<float>(info.specular.min)),
                   specular_max = number(static_cast<float>(info.specular.max));
  std::vector<Statement> all;
  const auto add = [&](const char* id, Expression value) {
    all.push_back({id, ValueType::kNumber, std::move(value)});
  };
  const auto add_color = [&](const char* id, Expression value) {
    all.push_back({id, ValueType::kColor, std::move(value)});
  };
  // Returns how far a value exceeds its limit: value / limit - 1, at least 0.
  const auto excess = [](const Expression& value, float limit) {
    return most(value * number(1.0f / limit) - number(1.0f), number(0.0f));
  };

  const bool is_alpha = info.source.roughness == RoughnessEncoding::kAlpha;
  add(is_alpha ? "alpha" : "own",
      least(most(named("width"), number(ends.width_from)), number(ends.width_to)));
  if (!is_alpha) add("alpha", alpha_of(info.source.roughness, "own"));
  add("inside", most(alpha, number(ends.alpha_min)));
  add("top", least(most(call("largest", {named("specular")}), specular_min), specular_max));
  add("t", top / (top + pole));
  add("wanted", alpha * factor_expression(form.alpha, "inside", "t"));
  Expression alpha_out = wanted, more = number(1.0f);
  if (form.specular_limit) {
    add("excess", excess(top * factor_expression(form.specular, "inside", "t"), *form.specular_limit));
    Expression cut = named("excess");
    if (form.hinge.bend != 0.0f) {
      add("cut", cut / (number(1.0f) + number(form.hinge.bend) * cut));
      cut = named("cut");
    }
    alpha_out = wanted + alpha * cut * (number(form.hinge.turn) + number(form.hinge.turn_by_alpha) * inside);
  }
  if (form.alpha_limit) {
    add("more", number(1.0f) + number(form.hinge.spread) * excess(wanted, *form.alpha_limit));
    more = named("more");
  }
  alpha_out = most(std::move(alpha_out), number(ends.least_alpha));
  if (form.alpha_limit) alpha_out = least(std::move(alpha_out), number(*form.alpha_limit));
  if (info.target.roughness != RoughnessEncoding::kAlpha) {
    add("target", std::move(alpha_out));
    alpha_out = native_of(info.target.roughness, "target");
  }
  add("width_out", std::move(alpha_out));
  add_color("s", most(named("specular"), number(0.0f)));
  add_color("held", least(info.specular.min > 0.0 ? most(s, specular_min) : s, specular_max));
  add_color("u", held / (held + pole));
  Expression specular_out = s * factor_expression(form.specular, "inside", "u") * more;
  if (form.specular_limit) specular_out = least(std::move(specular_out), number(*form.specular_limit));
  add_color("specular_out", std::move(specular_out));
  return used(std::move(all));
}

}  // namespace remap
