#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "core/number_text.hpp"
#include "emit/emit.hpp"
#include "emit/header_data.hpp"
#include "formula/expression.hpp"
#include "formula/text_template.hpp"
#include "remap/version.hpp"

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

std::string plain_number(float value) { return number_text(decimal_value(value)); }
// Writes a point, because shaders read a number without a point as an integer.
std::string point_number(float value) {
  const std::string text = plain_number(value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

// A Parts holds a converter as text.
struct Parts {
  std::string id, meaning;
  std::vector<Statement> numbers, colors;
};

// Returns a sentence about units and errors.
std::string meaning_of(const Fit& fit) {
  std::string text = side_text(fit.source) + " to " + side_text(fit.target) + ".";
  if (fit.pictures)
    text += " Pictures differ by " + fixed(fit.pictures->rmse, 1) +
            " % of white, where numbers are copied by " + fixed(fit.copied_pictures->rmse, 1) + " %.";
  return text;
}

Parts parts_of(const Fit& fit) {
  Parts parts{fit.id, meaning_of(fit), {}, {}};
  for (Statement& statement : formula_of(require_converter(fit)))
    (statement.type == ValueType::kColor ? parts.colors : parts.numbers).push_back(std::move(statement));
  return parts;
}

// Returns a line for each statement, with `start`, its name and its value. The line of an output begins with
// `last` instead of `start`.
std::string lines_of(const std::vector<Statement>& statements, const Notation& notation,
                     const std::string& start, const std::string& last, const std::string& end) {
  const std::vector<std::string> colors =
      notation.channel.empty() ? std::vector<std::string>() : std::vector<std::string>{"specular"};
  std::string text;
  for (const Statement& statement : statements)
    text += (statement.name.ends_with("_out") ? last : start + statement.name + " = ") +
            text_of(statement.value, notation, colors) + end + "\n";
  return text;
}

std::string c_function(const Parts& parts) {
  const Notation notation{float_literal,
                          calls_by({{"min", "fminf"},
                                    {"max", "fmaxf"},
                                    {"sqrt", "sqrtf"},
                                    {"largest", "fmaxf(fmaxf($1[0], $1[1]), $1[2])"}}),
                          "[c]"};
  return "static inline float remap_" + parts.id + "(float width, float specular[3]) {\n" +
         lines_of(parts.numbers, notation, "  const float ", "  const float width_out = ", ";") +
         "  for (int c = 0; c < 3; ++c) {\n" +
         lines_of(parts.colors, notation, "    const float ", "    specular[c] = ", ";") +
         "  }\n  return width_out;\n}\n";
}

std::string python_function(const Parts& parts) {
  const Notation notation{plain_number, calls_by({{"sqrt", "math.sqrt"}, {"largest", "max($1)"}}), "[c]"};
  return "def " + parts.id + "(width, specular):\n" +
         lines_of(parts.numbers, notation, "    ", "    width_out = ", "") +
         "    specular_out = [0.0] * 3\n    for c in range(3):\n" +
         lines_of(parts.colors, notation, "        ", "        specular_out[c] = ", "") +
         "    return width_out, specular_out\n";
}

std::string script_function(const Parts& parts) {
  const Notation notation{
      plain_number,
      calls_by(
          {{"min", "Math.min"}, {"max", "Math.max"}, {"sqrt", "Math.sqrt"}, {"largest", "Math.max(...$1)"}}),
      "[c]"};
  return "export function " + parts.id + "(width, specular) {\n" +
         lines_of(parts.numbers, notation, "  const ", "  const width_out = ", ";") +
         "  const specular_out = [0, 1, 2].map((c) => {\n" +
         lines_of(parts.colors, notation, "    const ", "    return ", ";") +
         "  });\n  return { width: width_out, specular: specular_out };\n}\n";
}

std::string shader_function(const Parts& parts, const std::string& color_type) {
  const Notation notation{point_number, calls_by({{"largest", "max(max($1.r, $1.g), $1.b)"}}), ""};
  return "void remap_" + parts.id + "(inout float width, inout " + color_type + " specular) {\n" +
         lines_of(parts.numbers, notation, "  float ", "  width = ", ";") +
         lines_of(parts.colors, notation, "  " + color_type + " ", "  specular = ", ";") + "}\n";
}

std::string material_function(const Parts& parts) {
  GraphWriter writer({{"width", ValueType::kNumber}, {"specular", ValueType::kColor}});
  for (const std::vector<Statement>* statements : {&parts.numbers, &parts.colors})
    for (const Statement& statement : *statements) writer.write(statement);
  const std::string node = "remap_" + parts.id;
  return "  <nodedef name=\"ND_" + node + "\" node=\"" + node +
         "\" nodegroup=\"math\">\n    <input name=\"width\" type=\"float\" value=\"0.5\" />\n"
         "    <input name=\"specular\" type=\"color3\" value=\"0.5, 0.5, 0.5\" />\n"
         "    <output name=\"width_out\" type=\"float\" />\n    <output name=\"specular_out\" "
         "type=\"color3\" />\n"
         "  </nodedef>\n  <nodegraph name=\"NG_" +
         node + "\" nodedef=\"ND_" + node + "\">\n" + writer.nodes() + writer.outputs() + "  </nodegraph>\n";
}

// A Frame is the text around the functions of a language.
struct Frame {
  std::string comment, units, begin, end;
  std::function<std::string(const Parts&)> function;
};

Frame frame_of(Language language, const std::string& name) {
  const std::string specular = "specular: red, green and blue, linear. ",
                    guard = "REMAP_" + upper_case(name) + "_H";
  switch (language) {
    case Language::kC:
      return {"//", specular + "They are replaced; the target's width is returned.",
              "#ifndef " + guard + "\n#define " + guard + "\n\n#include <math.h>\n", "\n#endif\n",
              c_function};
    case Language::kPython:
      return {"#", specular + "Returns width and specular of the target.", "import math\n", "",
              python_function};
    case Language::kJavaScript:
      return {"//", specular + "Returns { width, specular } of the target.", "", "", script_function};
    case Language::kGlsl:
      return {"//", specular + "Both are replaced.", "", "",
              [](const Parts& parts) { return shader_function(parts, "vec3"); }};
    case Language::kHlsl:
      return {"//", specular + "Both are replaced.", "", "",
              [](const Parts& parts) { return shader_function(parts, "float3"); }};
    case Language::kMaterialX:
      break;
  }
  return {"", specular + "A node for each converter.", "", "</materialx>\n", material_function};
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

std::string extension_of(Language language) {
  switch (language) {
    case Language::kC:
      return ".h";
    case Language::kPython:
      return ".py";
    case Language::kJavaScript:
      return ".mjs";
    case Language::kGlsl:
      return ".glsl";
    case Language::kHlsl:
      return ".hlsl";
    case Language::kMaterialX:
      break;
  }
  return ".mtlx";
}

std::string emit_functions(const std::vector<Fit>& fits, Language language, const std::string& name) {
  const Frame frame = frame_of(language, name);
  const auto comment = [&](const std::string& line) {
    return frame.comment.empty() ? "<!-- " + line + " -->\n" : frame.comment + " " + line + "\n";
  };
  std::string text = frame.comment.empty() ? "<?xml version=\"1.0\"?>\n" : "";
  text +=
      comment("Generated by remapc " + std::string(kVersion) + ". Do not edit: run `remapc emit`.") +
      comment("SPDX-License-Identifier: MIT-0 (free of conditions: copy what you need into any project).") +
      comment("width, in the unit that stands in brackets; " + frame.units);
  text += frame.comment.empty() ? "<materialx version=\"1.38\">\n" : frame.begin;
  for (const Fit& fit : fits) {
    const Parts parts = parts_of(fit);
    text += "\n" + comment(parts.meaning) + frame.function(parts);
  }
  return text + frame.end;
}

}  // namespace remap
