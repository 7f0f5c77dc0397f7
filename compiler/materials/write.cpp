// This file writes the translations of whole materials as a C++ header, as a Python module, and as node
// graphs of MaterialX.
#include <algorithm>
#include <cctype>

#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "formula/expression.hpp"
#include "formula/text_template.hpp"
#include "materials/description.hpp"
#include "remap/version.hpp"

namespace remap {
namespace {

// Turns `open_pbr_surface` into `OpenPbrSurface`.
std::string type_name(const std::string& id) {
  std::string name;
  bool is_first = true;
  for (const char letter : id) {
    if (letter != '_')
      name += is_first ? static_cast<char>(std::toupper(static_cast<unsigned char>(letter))) : letter;
    is_first = letter == '_';
  }
  return name;
}

std::string header_code_of(const Expression& expression) {
  return text_of(expression, {float_literal,
                              calls_by({{"min", "least"},
                                        {"max", "most"},
                                        {"pow", "power"},
                                        {"sqrt", "root"},
                                        {"exp", "std::exp"},
                                        {"color", "Color"},
                                        {"channel", "$1[static_cast<int>($2)]"},
                                        {"if_greater", "($1 > $2 ? $3 : $4)"},
                                        {"if_equal", "($1 == $2 ? $3 : $4)"}}),
                              ""});
}

std::string header_value_of(const MaterialInput& input) {
  if (input.type != ValueType::kColor) return " = " + float_literal(input.value[0]);
  return "{" + joined(input.value, ", ", float_literal) + "}";
}

std::string struct_code(const MaterialModel& model) {
  std::string text = "\n// " + model.title + "\nstruct " + type_name(model.id) + " {\n";
  std::string visits;
  for (const MaterialInput& input : model.inputs) {
    text += std::string("  ") + (input.type == ValueType::kColor ? "Color " : "float ") + input.name +
            header_value_of(input) + ";\n";
    visits += "    visit(\"" + input.name + "\", material." + input.name + ");\n";
  }
  return text +
         "\n  // Calls visit(name, value) for each input.\n"
         "  template <class Material, class Visit>\n  static void for_each(Material&& material, Visit&& "
         "visit) {\n" +
         visits + "  }\n};\n";
}

std::string header_function_code(const FormulaFunction& function) {
  std::string types, parameters;
  for (const std::string& parameter : function.parameters) {
    const std::string type = "T" + std::to_string(static_cast<int>(&parameter - function.parameters.data()));
    types += (types.empty() ? "class " : ", class ") + type;
    parameters += (parameters.empty() ? "" : ", ") + type + " " + parameter;
  }
  return "\n" + commented(function.comment, "", "//") + "template <" + types + ">\nauto " + function.name +
         "(" + parameters + ") {\n  return " + header_code_of(function.body) + ";\n}\n";
}

std::string header_translation_code(const Translation& translation) {
  const std::string to = type_name(translation.to->id);
  std::string text = "\n" + commented(translation.comment, "", "//") + "inline " + to + " " +
                     translation.id() + "(const " + type_name(translation.from->id) + "& source) {\n  " + to +
                     " target;\n";
  for (const Statement& line : translation.lines) {
    const bool is_output = line.name.starts_with("target.");
    const std::string type = line.type == ValueType::kColor ? "const Color " : "const float ";
    text += commented(line.comment, "  ", "//") + "  " + (is_output ? "" : type) + line.name + " = " +
            header_code_of(line.value) + ";\n";
  }
  return text + "  return target;\n}\n";
}

std::string number_of(float value) { return number_text(decimal_value(value)); }

std::string module_code_of(const Expression& expression) {
  return text_of(expression, {number_of,
                              calls_by({{"min", "np.minimum"},
                                        {"max", "np.maximum"},
                                        {"mix", "_mix"},
                                        {"pow", "np.power"},
                                        {"sqrt", "np.sqrt"},
                                        {"exp", "np.exp"},
                                        {"square", "np.square"},
                                        {"largest", "_largest"},
                                        {"channel", "_channel"},
                                        {"color", "_color"},
                                        {"if_greater", "np.where($1 > $2, $3, $4)"},
                                        {"if_equal", "np.where($1 == $2, $3, $4)"}}),
                              ""});
}

std::string module_value_of(const MaterialInput& input) {
  if (input.type != ValueType::kColor) return number_of(input.value[0]);
  return "(" + joined(input.value, ", ", number_of) + ")";
}

std::string models_code(const MaterialLibrary& library) {
  std::string text = "MODELS = {\n";
  for (const MaterialModel& model : library.models) {
    text += "    \"" + model.id + "\": {  # " + model.title + "\n";
    for (const MaterialInput& input : model.inputs)
      text += "        \"" + input.name + "\": " + module_value_of(input) + ",\n";
    text += "    },\n";
  }
  return text + "}\n";
}

std::string module_function_code(const FormulaFunction& function) {
  return "\n\ndef " + function.name + "(" +
         joined(function.parameters, ", ", [](const std::string& name) { return name; }) + "):\n" +
         commented(function.comment, "    ", "#") + "    return " + module_code_of(function.body) + "\n";
}

std::string module_translation_code(const Translation& translation) {
  std::string summary = translation.comment;
  for (std::size_t at = 0; (at = summary.find('\n', at)) != std::string::npos; at += 5)
    summary.insert(at + 1, 4, ' ');
  std::string text = "\n\ndef " + translation.id() + "(material):\n    \"\"\"" + summary +
                     "\"\"\"\n    source, target = _read(\"" + translation.from->id +
                     "\", material), SimpleNamespace()\n    with np.errstate(all=\"ignore\"):\n";
  for (const Statement& line : translation.lines) {
    const bool widens = line.type == ValueType::kColor && line.name.starts_with("target.");
    const std::string code = module_code_of(line.value);
    text += commented(line.comment, "        ", "#") + "        " + line.name + " = " +
            (widens ? "_color(" + code + ")" : code) + "\n";
  }
  return text + "    return _result(\"" + translation.to->id + "\", target)\n";
}

std::string graph_value(const MaterialInput& input) {
  if (input.type == ValueType::kBoolean) return input.value[0] == 0.0f ? "false" : "true";
  std::string text;
  for (const float value : input.value)
    text += (text.empty() ? "" : ", ") + number_text(decimal_value(value));
  return text;
}

using Definitions = std::map<std::string, GraphFunction>;

GraphWriter graph_of(const Translation& translation, const MaterialLibrary& library,
                     Definitions& definitions) {
  std::map<std::string, ValueType> inputs;
  for (const MaterialInput& input : translation.from->inputs) inputs["source." + input.name] = input.type;
  GraphWriter writer(std::move(inputs), library.functions, &definitions);
  for (const Statement& line : translation.lines) {
    Statement statement = line;
    if (statement.name.starts_with("target.")) statement.name = statement.name.substr(7) + "_out";
    writer.write(statement);
  }
  return writer;
}

std::string definition_of(const Translation& translation, const MaterialLibrary& library,
                          Definitions& definitions) {
  const GraphWriter graph = graph_of(translation, library, definitions);
  const std::string& name = translation.id();
  std::string text = "  <nodedef name=\"ND_" + name + "\" node=\"" + name + "\" nodegroup=\"translation\">\n";
  for (const MaterialInput& input : translation.from->inputs)
    text += "    <input name=\"" + input.name + "\" type=\"" + material_x_type(input.type) + "\" value=\"" +
            graph_value(input) + "\" />\n";
  for (const Statement& line : translation.lines)
    if (line.name.starts_with("target."))
      text += "    <output name=\"" + line.name.substr(7) + "_out\" type=\"" + material_x_type(line.type) +
              "\" />\n";
  return text + "  </nodedef>\n  <nodegraph name=\"NG_" + name + "\" nodedef=\"ND_" + name + "\">\n" +
         graph.nodes() + graph.outputs() + "  </nodegraph>\n";
}

bool has_node(const MaterialModel& model) { return model.id != "principled"; }

}  // namespace

std::string commented(const std::string& comment, const std::string& indent, const std::string& mark) {
  std::string text;
  for (std::size_t at = 0; at < comment.size();) {
    const std::size_t end = std::min(comment.find('\n', at), comment.size());
    text += indent + mark + " " + comment.substr(at, end - at) + "\n";
    at = end + 1;
  }
  return text;
}

std::string materials_header(const MaterialLibrary& library) {
  std::string structs, functions, translations;
  for (const MaterialModel& model : library.models) structs += struct_code(model);
  for (const FormulaFunction& function : library.functions) functions += header_function_code(function);
  for (const Translation& translation : library.translations)
    translations += header_translation_code(translation);
  return fill_template(code_file("materials_header"), {{"version", std::string(kVersion)},
                                                       {"structs", structs},
                                                       {"functions", functions},
                                                       {"translations", translations}});
}

std::string materials_module(const MaterialLibrary& library) {
  const auto quoted = [](const std::string& name) { return "\"" + name + "\""; };
  std::string functions, translations, table, ignored;
  for (const FormulaFunction& function : library.functions) functions += module_function_code(function);
  for (const Translation& translation : library.translations) {
    translations += module_translation_code(translation);
    const std::string key = "    (" + quoted(translation.from->id) + ", " +
                            quoted(translation.to->id + translation.variant) + "): ";
    table += key + translation.id() + ",\n";
    ignored += key + "(" + joined(translation.ignored(), ", ", quoted) +
               (translation.ignored().empty() ? "" : ",") + "),\n";
  }
  return fill_template(code_file("materials_module"), {{"version", std::string(kVersion)},
                                                       {"models", models_code(library)},
                                                       {"functions", functions},
                                                       {"translations", translations},
                                                       {"table", table},
                                                       {"ignored", ignored}});
}

std::string materials_graphs(const MaterialLibrary& library) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<!-- Generated by remapc " + std::string(kVersion) +
      ". Do not edit: run `remapc emit`. -->\n"
      "<!-- SPDX-License-Identifier: MIT-0 (free of conditions: copy what you need into any project). -->\n"
      "<!-- Translations of whole materials. Load this file before MaterialX' own libraries, which keep the "
      "first node of a name. -->\n<materialx version=\"1.39\">\n";
  Definitions definitions;
  std::string translations;
  for (const Translation& translation : library.translations)
    if (has_node(*translation.from) && has_node(*translation.to))
      translations += "\n" + definition_of(translation, library, definitions);
  for (const auto& [name, definition] : definitions) text += "\n" + definition.text;
  return text + translations + "</materialx>\n";
}

}  // namespace remap
