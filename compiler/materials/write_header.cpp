// This file writes the C++ header with the translations of whole materials.
#include <algorithm>
#include <cctype>

#include "core/number_text.hpp"
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

}  // namespace remap
