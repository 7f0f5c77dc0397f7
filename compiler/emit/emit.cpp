// This file makes a header from a fit in two steps. describe() returns the data of the header
// (header_data.hpp), and fill() its text. templates/frame.in is the frame around the part for each kind.
// templates/converter*.in is for width and specular, templates/material*.in for whole materials.
#include "emit/emit.hpp"

#include <algorithm>
#include <map>

#include "core/number_text.hpp"
#include "core/plain_text.hpp"
#include "emit/header_data.hpp"
#include "formula/text_template.hpp"
#include "materials/description.hpp"
#include "remap/version.hpp"

namespace remap {
namespace {

constexpr std::size_t kLongestEscape = 6;  // escape of one byte

using Parameters = std::vector<MaterialParameter>;

std::string numbers(const std::vector<float>& values) {
  return "{" + joined(values, ", ", float_literal) + "}";
}

std::string type_of(const MaterialParameter& parameter, const std::string& one) {
  return parameter.channel_count == 3 ? "std::array<" + one + ", 3> " : one + " ";
}

std::string members(const Parameters& parameters) {
  return joined(parameters, "\n", [](const MaterialParameter& parameter) {
    return type_of(parameter, "float") + parameter.name + ";  // " + parameter.meaning;
  });
}

std::string pointers(const Parameters& parameters) {
  return joined(parameters, "\n", [](const MaterialParameter& parameter) {
    return type_of(parameter, "T*") + parameter.name + ";";
  });
}

std::string strides(const Parameters& parameters) {
  return joined(parameters, ", ",
                [](const MaterialParameter& parameter) { return parameter.name + "_stride = 1"; });
}

// Returns the stride of each channel, such as in.diffuse_stride three times.
std::string channel_strides(const Parameters& parameters, const std::string& prefix) {
  return joined(parameters, ", ", [&](const MaterialParameter& parameter) {
    const std::string text = prefix + parameter.name + "_stride";
    return parameter.channel_count == 1 ? text : text + ", " + text + ", " + text;
  });
}

// Returns `prefix` and the member of each channel: &in.diffuse[0], &in.diffuse[1], ...
std::string channels(const Parameters& parameters, const std::string& prefix) {
  return joined(parameters, ", ", [&](const MaterialParameter& parameter) {
    const std::string text = prefix + parameter.name;
    return parameter.channel_count == 1 ? text : text + "[0], " + text + "[1], " + text + "[2]";
  });
}

std::string channel_count(const Parameters& parameters) {
  int count = 0;
  for (const MaterialParameter& parameter : parameters) count += parameter.channel_count;
  return std::to_string(count);
}

// Returns one row for each channel, with the values of all texels.
std::string golden_rows(const std::vector<GoldenValues>& golden, std::vector<float> GoldenValues::*part) {
  std::string text;
  for (std::size_t channel = 0; channel < (golden[0].*part).size(); ++channel) {
    std::vector<float> row;
    for (const GoldenValues& texel : golden) row.push_back((texel.*part)[channel]);
    text += numbers(row) + ",\n";
  }
  return text;
}

std::string include_lines(const std::vector<std::string>& names) {
  return joined(names, "", [](const std::string& name) { return "#include <" + name + ">\n"; });
}

// Return the values of templates/frame.in that differ between kinds.
std::map<std::string, std::string> values_of(const HeaderData& data, const ConverterData& converter) {
  const ConverterInfo& info = converter.info;
  // These are the golden texels, two on each line.
  std::string golden;
  for (std::size_t i = 0; i < data.golden.size(); ++i) {
    std::vector<float> values = data.golden[i].in;
    for (const std::vector<float>* more : {&data.golden[i].out, &data.golden[i].within})
      values.insert(values.end(), more->begin(), more->end());
    golden += numbers(values) + (i % 2 == 0 && i + 1 < data.golden.size() ? ", " : ",\n");
  }
  const auto meaning = [](const HeaderEnd& end) {
    return end.parameters[0].meaning + "; " + end.parameters[1].meaning;
  };
  return {
      {"includes",
       include_lines({"array", "cstddef", "cstdint", "cstring", "limits", "type_traits", "utility"})},
      {"detail", ""},
      // Every header has the names of the widths, so these are only the names of specular in both models.
      {"constants", "static constexpr const char* kSourceSpecular = \"" + info.source.specular +
                        "\";\nstatic constexpr const char* kTargetSpecular = \"" + info.target.specular +
                        "\";"},
      {"body", fill_template(code_file("converter"), {{"source_meaning", meaning(data.source)},
                                                      {"target_meaning", meaning(data.target)},
                                                      {"golden_count", std::to_string(data.golden.size())},
                                                      {"golden", golden},
                                                      {"form", form_code(converter)}})}};
}

template <typename Material>  // a conversion of workflows, or a warp
std::map<std::string, std::string> values_of(const HeaderData& data, const Material& material) {
  const Parameters &in = data.source.parameters, &out = data.target.parameters;
  const MaterialCode code = material_code(material);
  const std::string input_count = channel_count(in), output_count = channel_count(out);
  return {
      {"includes",
       include_lines({"array", "cmath", "cstddef", "cstdint", "cstring", "type_traits", "utility"})},
      {"detail",
       fill_template(code_file("detail"), {{"id", data.id},
                                           {"functions", code.functions +
                                                             fill_template(code_file("material_rows"),
                                                                           {{"block", code.block},
                                                                            {"call", code.call},
                                                                            {"input_count", input_count},
                                                                            {"output_count", output_count}}) +
                                                             code_files({"strided"})}})},
      {"constants", fill_template(code_file("material_constants"), {{"formula", code.formula},
                                                                    {"source_workflow", data.source.workflow},
                                                                    {"target_workflow", data.target.workflow},
                                                                    {"source_diffuse", data.source.diffuse},
                                                                    {"target_diffuse", data.target.diffuse},
                                                                    {"constants", code.constants}})},
      {"body",
       fill_template(code_file("material"), {{"id", data.id},
                                             {"input_members", members(in)},
                                             {"output_members", members(out)},
                                             {"input_pointers", pointers(in)},
                                             {"output_pointers", pointers(out)},
                                             {"input_strides", strides(in)},
                                             {"output_strides", strides(out)},
                                             {"in_strides", channel_strides(in, "in.")},
                                             {"out_strides", channel_strides(out, "out.")},
                                             {"input_count", input_count},
                                             {"output_count", output_count},
                                             {"in_flat", channels(in, "in.")},
                                             {"out_flat", channels(out, "out.")},
                                             {"in_addresses", channels(in, "&in.")},
                                             {"out_addresses", channels(out, "&out.")},
                                             {"within", code.within},
                                             {"golden_count", std::to_string(data.golden.size())},
                                             {"golden_in", golden_rows(data.golden, &GoldenValues::in)},
                                             {"golden_out", golden_rows(data.golden, &GoldenValues::out)}})}};
}

// Makes a line of text safe for a comment. A backslash at its end, even before blanks, or the trigraph of a
// backslash would join the next line of code to the comment.
std::string commented(std::string_view line) {
  const std::size_t end = line.find_last_not_of(" \t");
  const std::string_view text = line.substr(0, end == std::string_view::npos ? 0 : end + 1);
  const std::string safe = plain(text, text.size() * kLongestEscape);
  return safe + (safe.ends_with('\\') || safe.ends_with("?\?/") ? "." : "");
}

// Only this function writes text from fits into a header. Names have separate rules (is_valid_id() and
// others).
std::string comment_lines(std::string_view text) {
  std::string lines;
  for (;;) {
    const std::size_t end = text.find('\n');
    lines += "// " + commented(text.substr(0, end));
    if (end == std::string_view::npos) return lines;
    lines += "\n";
    text.remove_prefix(end + 1);
  }
}

}  // namespace

std::string fill(const HeaderData& data) {
  std::map<std::string, std::string> values =
      std::visit([&](const auto& code) { return values_of(data, code); }, data.code);
  values.insert({{"version", kVersion},
                 {"id", data.id},
                 {"title", data.title},
                 {"provenance", comment_lines(data.provenance)},
                 {"guard", "REMAP_GENERATED_" + upper_case(data.id) + "_HPP"},
                 {"source", data.source.model},
                 {"source_width", data.source.width},
                 {"target", data.target.model},
                 {"target_width", data.target.width}});
  return fill_template(code_file("frame"), values);
}

std::string emit_header(const Fit& fit) { return fill(describe(fit)); }

std::string emit_header(const WorkflowFit& fit) { return fill(describe(fit)); }

std::string emit_header(const WarpMapFit& fit) { return fill(describe(fit)); }

std::vector<EmittedFile> emit_shared_files(std::vector<Fit> fits) {
  std::ranges::sort(fits, {},
                    [](const Fit& fit) -> const std::string& { return require_converter(fit).info.id; });
  std::vector<ConverterData> converters;
  for (const Fit& fit : fits) converters.push_back(require_converter(fit));
  const MaterialLibrary& materials = material_library();
  std::vector<EmittedFile> files = {{"converters.json", converters_to_json(converters)},
                                    {"materials/materials.hpp", materials_header(materials)},
                                    {"materials/materials.py", materials_module(materials)},
                                    {"materialx/remap_translation.mtlx", materials_graphs(materials)}};
  const auto is_lobe = [](const ModelSide& side) {
    return side.model.starts_with("mitsuba/") || side.model.starts_with("legacy/");
  };
  std::erase_if(fits, [&](const Fit& fit) { return !is_lobe(fit.source) || !is_lobe(fit.target); });
  if (fits.empty()) return files;
  for (const auto& language : kLanguages)
    files.push_back({"languages/converters" + extension_of(language.value),
                     emit_functions(fits, language.value, "converters")});
  return files;
}

}  // namespace remap
