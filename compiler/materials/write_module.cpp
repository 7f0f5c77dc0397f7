// This file writes the Python module with the translations of whole materials.
#include "core/number_text.hpp"
#include "formula/text_template.hpp"
#include "materials/description.hpp"
#include "remap/version.hpp"

namespace remap {
namespace {

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

}  // namespace

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

}  // namespace remap
