#include "lower/short_form.hpp"

#include <algorithm>
#include <cmath>

#include "core/json_field.hpp"
#include "core/number_text.hpp"

namespace remap {
namespace {

ShortExpression operator""_n(long double value) {
  return {ShortOp::kNumber, static_cast<double>(value), "", {}};
}
ShortExpression constant(double value) { return {ShortOp::kNumber, value, "", {}}; }
ShortExpression in(const char* name) { return {ShortOp::kInput, 0.0, name, {}}; }
ShortExpression joined(ShortOp op, ShortExpression a, ShortExpression b) {
  return {op, 0.0, "", {std::move(a), std::move(b)}};
}
ShortExpression operator+(ShortExpression a, ShortExpression b) {
  return joined(ShortOp::kAdd, std::move(a), std::move(b));
}
ShortExpression operator-(ShortExpression a, ShortExpression b) {
  return joined(ShortOp::kSubtract, std::move(a), std::move(b));
}
ShortExpression operator*(ShortExpression a, ShortExpression b) {
  return joined(ShortOp::kMultiply, std::move(a), std::move(b));
}
ShortExpression operator/(ShortExpression a, ShortExpression b) {
  return joined(ShortOp::kDivide, std::move(a), std::move(b));
}
ShortExpression least(ShortExpression a, ShortExpression b) {
  return joined(ShortOp::kMin, std::move(a), std::move(b));
}
ShortExpression power(ShortExpression a, ShortExpression b) {
  return joined(ShortOp::kPower, std::move(a), std::move(b));
}

ShortExpression strength_of(const ShortForm& form) {
  const ShortExpression e = constant(form.constants[2]), f = constant(form.constants[3]), alpha = in("alpha");
  switch (form.strength) {
    case ShortStrength::kLine:
      return e + f * alpha;
    case ShortStrength::kSquare:
      return e + f * alpha * alpha;
    case ShortStrength::kOverLine:
      return e / (1.0_n + f * alpha);
    case ShortStrength::kOverSquare:
      return e / (1.0_n + f * alpha * alpha);
  }
  return e;
}

// The exponent of a half-vector lobe: that of a mirrored lobe times a factor, which is the last constant.
ShortExpression half_exponent(const ShortForm& form, std::size_t factor) {
  const double times = form.constants[factor];
  return times == 1.0 ? in("n") : constant(times) * in("n");
}

Json figures_json(const ShortFigures& figures) {
  return {{"rmse", rounded(figures.rmse, 4)},
          {"ssim", rounded(figures.ssim, 4)},
          {"relative", rounded(figures.relative, 4)}};
}

ShortFigures figures_of(const Field& field) {
  return {field["rmse"].number(), field["ssim"].number(), field["relative"].number()};
}

}  // namespace

double ShortExpression::value(const std::map<std::string, double>& inputs) const {
  if (op == ShortOp::kNumber) return number;
  if (op == ShortOp::kInput) return inputs.at(input);
  const double a = terms[0].value(inputs), b = terms[1].value(inputs);
  switch (op) {
    case ShortOp::kAdd:
      return a + b;
    case ShortOp::kSubtract:
      return a - b;
    case ShortOp::kMultiply:
      return a * b;
    case ShortOp::kDivide:
      return a / b;
    case ShortOp::kMin:
      return std::min(a, b);
    case ShortOp::kMax:
      return std::max(a, b);
    default:
      return std::pow(a, b);
  }
}

std::size_t constant_count(ShortKind kind) {
  switch (kind) {
    case ShortKind::kWidths:
      return 4;
    case ShortKind::kExponent:
      return 5;
    case ShortKind::kExponentNormal:
      return 4;
    case ShortKind::kToExponent:
      return 3;
  }
  return 0;
}

std::vector<ShortOutput> outputs_of(const ShortForm& form) {
  const auto c = [&](std::size_t i) { return constant(form.constants[i]); };
  // What a lobe leaves to diffuse. A mirror would divide by 0.
  const ShortExpression remaining = joined(ShortOp::kMax, 0.02_n, 1.0_n - in("f"));
  switch (form.kind) {
    case ShortKind::kWidths:
      return {{"alpha", {"alpha"}, least(1.0_n, in("alpha") * (c(0) + c(1) * in("alpha")))},
              {"specular", {"alpha", "specular"}, least(1.0_n, in("specular") * strength_of(form))}};
    case ShortKind::kExponent:
      return {{"roughness", {"n"}, power(c(0) / (half_exponent(form, 4) + c(1)), 0.25_n)},
              {"f0", {"n", "ks"}, least(1.0_n, c(2) * in("ks") / (half_exponent(form, 4) + c(3)))},
              {"base", {"kd", "f"}, least(1.0_n, in("kd") / remaining)}};
    case ShortKind::kExponentNormal:
      return {{"roughness", {"n"}, power(c(0) / (half_exponent(form, 3) + c(1)), 0.25_n)},
              {"f0", {"ks"}, least(1.0_n, c(2) * in("ks"))},
              {"base",
               {"kd", "ks", "n", "f"},
               least(1.0_n, (in("kd") + in("ks") / (half_exponent(form, 3) + 1.0_n)) / remaining)}};
    case ShortKind::kToExponent:
      return {{"n",
               {"roughness"},
               constant(rounded(form.constants[0] / form.constants[2], 3)) / power(in("roughness"), 4.0_n)},
              {"ks",
               {"roughness", "f0"},
               constant(rounded(form.constants[0] / form.constants[1], 3)) * in("f0") /
                   power(in("roughness"), 4.0_n)},
              {"kd", {"base", "metallic"}, 0.96_n * in("base") * (1.0_n - in("metallic"))}};
  }
  return {};
}

ShortTexel converted(const std::vector<ShortOutput>& outputs, ShortKind kind, double alpha, double specular) {
  const auto within = [](double value) { return std::isfinite(value) ? std::clamp(value, 1e-3, 1.0) : 1.0; };
  const auto exponent = [](double value) { return from_alpha(RoughnessConvention::kExponent, value); };
  std::map<std::string, double> inputs = {
      {"alpha", alpha}, {"specular", specular},          {"n", exponent(alpha)},
      {"ks", specular}, {"roughness", std::sqrt(alpha)}, {"f0", specular}};
  const double width = outputs[0].value.value(inputs);
  ShortTexel texel{0.0, std::max(0.0, outputs[1].value.value(inputs))};
  switch (kind) {
    case ShortKind::kWidths:
      texel.alpha = within(width);
      break;
    case ShortKind::kToExponent:
      texel.alpha = within(to_alpha(RoughnessConvention::kExponent, std::clamp(width, 0.1, 10000.0)));
      break;
    default:
      texel.alpha = within(width * width);
  }
  return texel;
}

std::string short_forms_json(const std::vector<ShortForm>& forms) {
  Json list = Json::list();
  for (const ShortForm& form : forms) {
    Json entry = {{"id", form.id},
                  {"source", form.source},
                  {"target", form.target},
                  {"kind", name_of(kShortKinds, form.kind)}};
    if (form.kind == ShortKind::kWidths) entry["strength"] = name_of(kShortStrengths, form.strength);
    entry["constants"] = form.constants;
    entry["figures"] = figures_json(form.figures);
    entry["best"] = figures_json(form.best);
    entry["copied"] = figures_json(form.copied);
    if (form.compiled) entry["compiled"] = figures_json(*form.compiled);
    list.push_back(std::move(entry));
  }
  return Json{{"format", "remap-short-forms"}, {"version", 1}, {"forms", list}}.dump(1) + "\n";
}

std::vector<ShortForm> short_forms_of(const std::string& text, const std::string& place) {
  const Json json = parse_json(text, place);
  const Field root(json, place);
  root["format"].require(root["format"].text() == "remap-short-forms", "remap-short-forms");
  root["version"].require(root["version"].count() == 1, "1");
  return root["forms"].list(0, [](const Field& entry) {
    ShortForm form;
    form.id = entry["id"].line();
    form.source = entry["source"].line();
    form.target = entry["target"].line();
    form.kind = entry["kind"].named(kShortKinds, "a kind of short form");
    if (form.kind == ShortKind::kWidths)
      form.strength = entry["strength"].named(kShortStrengths, "how specular changes with alpha");
    const std::size_t count = constant_count(form.kind);
    form.constants = entry["constants"].numbers(count);
    entry["constants"].require(form.constants.size() == count, std::to_string(count) + " numbers");
    form.figures = figures_of(entry["figures"]);
    form.best = figures_of(entry["best"]);
    form.copied = figures_of(entry["copied"]);
    if (entry.contains("compiled")) form.compiled = figures_of(entry["compiled"]);
    return form;
  });
}

}  // namespace remap
