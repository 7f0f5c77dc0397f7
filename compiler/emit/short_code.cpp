#include "emit/short_code.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <sstream>

#include "core/number_text.hpp"
#include "core/report_text.hpp"
#include "remap/version.hpp"

namespace remap {
namespace {

// How a language writes an expression.
struct Notation {
  std::string (*number)(double);
  std::string least, most;  // of two values, as functions
  std::string power;        // as a function; empty: an operator
  std::string raised;       // the operator
  std::string times = " * ";
};

std::string float_number(double value) { return float_literal(static_cast<float>(value)); }
std::string plain_number(double value) { return number_text(value); }
// Python divides whole numbers to floats, so that the text may be either.
const Notation kCNotation{float_number, "fminf", "fmaxf", "powf", "", " * "};
const Notation kCppNotation{float_number, "std::min", "std::max", "std::pow", "", " * "};
const Notation kPythonNotation{plain_number, "min", "max", "", " ** ", " * "};
const Notation kScriptNotation{plain_number, "Math.min", "Math.max", "", " ** ", " * "};
const Notation kPaperNotation{plain_number, "min", "max", "", "^", " "};

int rank_of(ShortOp op) {
  switch (op) {
    case ShortOp::kAdd:
    case ShortOp::kSubtract:
      return 1;
    case ShortOp::kMultiply:
    case ShortOp::kDivide:
      return 2;
    case ShortOp::kPower:
      return 3;
    default:
      return 4;
  }
}

std::string text_of(const ShortExpression& expression, const Notation& notation);

// In parentheses where it binds less than `rank`.
std::string inner_text(const ShortExpression& expression, const Notation& notation, int rank) {
  const std::string text = text_of(expression, notation);
  const bool is_call = expression.op == ShortOp::kPower && !notation.power.empty();
  return rank_of(expression.op) < rank && !is_call ? "(" + text + ")" : text;
}

// Of a product; of other expressions themselves.
ShortExpression& first_factor(ShortExpression& expression) {
  return expression.op == ShortOp::kMultiply ? first_factor(expression.terms[0]) : expression;
}

std::string text_of(const ShortExpression& expression, const Notation& notation) {
  const auto call = [&](const std::string& name) {
    return name + "(" + text_of(expression.terms[0], notation) + ", " +
           text_of(expression.terms[1], notation) + ")";
  };
  const auto infix = [&](const std::string& sign, int rank, int right) {
    return inner_text(expression.terms[0], notation, rank) + sign +
           inner_text(expression.terms[1], notation, right);
  };
  switch (expression.op) {
    case ShortOp::kNumber:
      return notation.number(expression.number);
    case ShortOp::kInput:
      return expression.input;
    case ShortOp::kAdd: {
      // `a + -b` is `a - b`.
      ShortExpression difference = expression;
      if (double& factor = first_factor(difference.terms[1]).number; factor < 0.0) {
        factor = -factor;
        difference.op = ShortOp::kSubtract;
        return text_of(difference, notation);
      }
      return infix(" + ", 1, 1);
    }
    case ShortOp::kSubtract:
      return infix(" - ", 1, 2);
    case ShortOp::kMultiply:
      return infix(notation.times, 2, 3);
    case ShortOp::kDivide:
      return infix(" / ", 2, 3);
    case ShortOp::kMin:
      return call(notation.least);
    case ShortOp::kMax:
      return call(notation.most);
    case ShortOp::kPower:
      return notation.power.empty() ? infix(notation.raised, 4, 4) : call(notation.power);
  }
  return "";
}

std::string figures_text(const ShortForm& form) {
  const auto triple = [&](const std::string& name, double ShortFigures::*figure, double factor, int digits) {
    std::string text = name + " " + fixed(factor * form.figures.*figure, digits) + " (best possible " +
                       fixed(factor * form.best.*figure, digits);
    if (form.compiled) text += ", compiled converter " + fixed(factor * *form.compiled.*figure, digits);
    return text + ", copied " + fixed(factor * form.copied.*figure, digits) + ")";
  };
  return triple("RMSE % of display values under environments", &ShortFigures::rmse, 1.0, 1) + ", " +
         triple("error % under a light", &ShortFigures::relative, 100.0, 0);
}

std::string title(const ShortForm& form) { return form.source + " to " + form.target; }

std::vector<std::string> meanings(const ShortForm& form) {
  switch (form.kind) {
    case ShortKind::kWidths:
      return {"alpha: width of the lobe. specular: F0 or scale, linear, a channel at a time."};
    case ShortKind::kExponent:
    case ShortKind::kExponentNormal:
      return {
          "n: exponent. ks, kd: linear, a channel at a time. roughness: square root of alpha. f: the largest "
          "f0 of the channels.",
          "Constant Fresnel: in glTF KHR_materials_specular with specularFactor = f and specularColorFactor "
          "= "
          "25 f0 / f."};
    case ShortKind::kToExponent:
      return {"roughness: square root of alpha. f0, base: linear, a channel at a time. ks may exceed 1."};
  }
  return {};
}

std::string head(const std::string& comment, const char* what) {
  return comment + " Generated by remapc " + std::string(kVersion) + ". Short forms: " + what + "\n" +
         comment +
         " Figures are of materials and lights that had no say in the constants; the source is in each "
         "name.\n";
}

std::string comments(const ShortForm& form, const std::string& comment) {
  std::string text = "\n" + comment + " " + title(form) + ". " + figures_text(form) + "\n";
  for (const std::string& meaning : meanings(form)) text += comment + " " + meaning + "\n";
  return text;
}

// A function a line.
struct Language {
  std::string comment, start, end;
  Notation notation;
  std::function<std::string(const std::string& name, const std::vector<std::string>& inputs,
                            const std::string& value)>
      function;
};

std::string joined(const std::vector<std::string>& words, const std::string& before) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + before + word;
  return text;
}

std::string code_of(const std::vector<ShortForm>& forms, const Language& language, const char* what) {
  std::string text = head(language.comment, what) + language.start;
  for (const ShortForm& form : forms) {
    text += comments(form, language.comment);
    for (const ShortOutput& output : outputs_of(form))
      text += language.function(form.id + "_" + output.name, output.inputs,
                                text_of(output.value, language.notation));
  }
  return text + language.end;
}

const Language kC{
    "//", "#ifndef REMAP_SHORT_FORMS_H\n#define REMAP_SHORT_FORMS_H\n\n#include <math.h>\n", "\n#endif\n",
    kCNotation,
    [](const std::string& name, const std::vector<std::string>& inputs, const std::string& value) {
      return "static inline float remap_" + name + "(" + joined(inputs, "float ") + ") { return " + value +
             "; }\n";
    }};
const Language kCpp{
    "//", "#pragma once\n\n#include <algorithm>\n#include <cmath>\n\nnamespace remap::short_forms {\n",
    "\n}  // namespace remap::short_forms\n", kCppNotation,
    [](const std::string& name, const std::vector<std::string>& inputs, const std::string& value) {
      return "inline float " + name + "(" + joined(inputs, "float ") + ") { return " + value + "; }\n";
    }};
const Language kPython{
    "#", "", "", kPythonNotation,
    [](const std::string& name, const std::vector<std::string>& inputs, const std::string& value) {
      return "def " + name + "(" + joined(inputs, "") + "): return " + value + "\n";
    }};
const Language kScript{
    "//", "", "", kScriptNotation,
    [](const std::string& name, const std::vector<std::string>& inputs, const std::string& value) {
      return "export const " + name + " = (" + joined(inputs, "") + ") => " + value + ";\n";
    }};

// An output of a form as nodes of MaterialX.
class NodeWriter {
 public:
  NodeWriter(const std::string& output, std::string& nodes) : output_(output), nodes_(nodes) {}

  // An input of a node: `nodename="..." type="float"`.
  struct Term {
    std::string type, attribute;
  };

  Term write(const ShortExpression& expression) {
    if (expression.op == ShortOp::kNumber)
      return {"float", "value=\"" + number_text(expression.number) + "\""};
    if (expression.op == ShortOp::kInput)
      return {type_of(expression.input), "interfacename=\"" + expression.input + "\""};
    Term a = write(expression.terms[0]), b = write(expression.terms[1]);
    static const std::map<ShortOp, const char*> kNodes = {
        {ShortOp::kAdd, "add"},       {ShortOp::kSubtract, "subtract"}, {ShortOp::kMultiply, "multiply"},
        {ShortOp::kDivide, "divide"}, {ShortOp::kMin, "min"},           {ShortOp::kMax, "max"},
        {ShortOp::kPower, "power"}};
    // The second term of a node may be a float beside a color, the first may not.
    if (a.type == "float" && b.type == "color3") std::swap(a, b);
    const std::string name = output_ + "_" + std::to_string(++count_);
    nodes_ += "    <" + std::string(kNodes.at(expression.op)) + " name=\"" + name + "\" type=\"" + a.type +
              "\">\n      <input name=\"in1\" type=\"" + a.type + "\" " + a.attribute +
              " />\n      <input name=\"in2\" type=\"" + b.type + "\" " + b.attribute + " />\n    </" +
              kNodes.at(expression.op) + ">\n";
    return {a.type, "nodename=\"" + name + "\""};
  }

  static std::string type_of(const std::string& name) {
    constexpr std::array<std::string_view, 6> kColors = {"ks", "kd", "f0", "base", "specular", "color"};
    return std::ranges::find(kColors, name) != kColors.end() ? "color3" : "float";
  }

 private:
  const std::string& output_;
  std::string& nodes_;
  int count_ = 0;
};

// A nodegraph an output, so that a document takes what it needs.
std::string materialx_of(const std::vector<ShortForm>& forms) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<!-- Generated by remapc " + std::string(kVersion) +
      ". Short forms: a node for each output. Figures are of materials and lights that had no say in the "
      "constants. -->\n<materialx version=\"1.38\">\n";
  for (const ShortForm& form : forms) {
    text += "\n  <!-- " + title(form) + ". " + figures_text(form) + " -->\n";
    for (const ShortOutput& output : outputs_of(form)) {
      std::string nodes;
      NodeWriter writer(output.name, nodes);
      const NodeWriter::Term term = writer.write(output.value);
      const std::string node = "remap_" + form.id + "_" + output.name,
                        type = NodeWriter::type_of(output.name);
      text += "  <nodedef name=\"ND_" + node + "\" node=\"" + node + "\" nodegroup=\"math\">\n";
      for (const std::string& input : output.inputs) {
        const std::string input_type = NodeWriter::type_of(input);
        text += "    <input name=\"" + input + "\" type=\"" + input_type + "\" value=\"" +
                (input_type == "color3" ? "0.5, 0.5, 0.5"
                 : input == "n"         ? "32"
                                        : "0.5") +
                "\" />\n";
      }
      text += "    <output name=\"out\" type=\"" + type + "\" />\n  </nodedef>\n  <nodegraph name=\"NG_" +
              node + "\" nodedef=\"ND_" + node + "\">\n" + nodes + "    <output name=\"out\" type=\"" + type +
              "\" " + term.attribute + " />\n  </nodegraph>\n";
    }
  }
  return text + "</materialx>\n";
}

std::string csv_of(const std::vector<ShortForm>& forms) {
  std::string text =
      "id,source,target,form,rmse,ssim,relative,best_rmse,best_ssim,best_relative,compiled_rmse,compiled_"
      "ssim,"
      "compiled_relative,copied_rmse,copied_ssim,copied_relative\n";
  const auto figures = [](const ShortFigures& all) {
    return "," + number_text(rounded(all.rmse, 4)) + "," + number_text(rounded(all.ssim, 4)) + "," +
           number_text(rounded(all.relative, 4));
  };
  for (const ShortForm& form : forms)
    text += form.id + "," + form.source + "," + form.target + ",\"" + short_text(form) + "\"" +
            figures(form.figures) + figures(form.best) + (form.compiled ? figures(*form.compiled) : ",,,") +
            figures(form.copied) + "\n";
  return text;
}

}  // namespace

std::string short_text(const ShortForm& form) {
  std::string text;
  for (const ShortOutput& output : outputs_of(form))
    text += (text.empty() ? "" : "; ") + output.name + " = " + text_of(output.value, kPaperNotation);
  return text;
}

std::vector<ShortCode> short_code(const std::vector<ShortForm>& forms) {
  return {{".h", code_of(forms, kC, "C99, a function for each output.")},
          {".hpp", code_of(forms, kCpp, "C++17, a function for each output.")},
          {".py", code_of(forms, kPython, "Python 3, a function of floats for each output.")},
          {".mjs", code_of(forms, kScript, "JavaScript, a function for each output.")},
          {".mtlx", materialx_of(forms)},
          {".csv", csv_of(forms)},
          {".json", short_forms_json(forms)}};
}

}  // namespace remap
