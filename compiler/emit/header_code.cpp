// This file writes the part of a header that differs between converters: compact forms, networks, conversions
// between workflows, and appearance warps. It takes the code of runtime/stages/code and adds the numbers.
#include <algorithm>
#include <array>
#include <span>
#include <type_traits>

#include "core/number_text.hpp"
#include "emit/emit.hpp"
#include "emit/header_data.hpp"
#include "formula/text_template.hpp"
#include "reference/workflow_conversion.hpp"
#include "stages/packed_warp.hpp"

namespace remap {
namespace {

std::string float_text(float value) { return literal(static_cast<double>(value)); }

std::string code_of(const Expression& expression) {
  return text_of(expression,
                 {float_literal, calls_by({{"min", "least"}, {"max", "most"}, {"sqrt", "root"}})});
}

bool depends_on_alpha(const FactorTerms& factor) {
  return std::ranges::any_of(factor, [](const auto& row) { return row.size() > 1; });
}

std::string limit_text(const std::optional<float>& limit) {
  return limit ? float_text(*limit) : "std::numeric_limits<float>::infinity()";
}

constexpr std::size_t kCacheFloats = 6144;  // size of all rows: 24 of the 32 KB of a first-level cache
constexpr std::size_t kUnitsAtOnce = 4;     // hidden units that `two_layers` (layers.in) computes together

std::string layer_table(const std::string& name, const Layer& layer) {
  std::vector<std::string> numbers;
  for (std::size_t j = 0; j < layer.output_count(); ++j) {
    numbers.push_back(literal(layer.biases[j]));
    for (std::size_t k = 0; k < layer.input_count; ++k)
      numbers.push_back(literal(layer.weights[j * layer.input_count + k]));
  }
  return table_code(name, layer.input_count + 1, numbers);
}

// Returns the calls that compute each layer from the rows of the previous layer. `last` receives the name of
// the last rows.
std::string layer_calls(const std::string& name, const std::vector<Layer>& layers, std::string* last) {
  const auto table = [&](std::size_t l) { return "k_" + name + "_" + std::to_string(l); };
  const auto units = [&](std::size_t l) { return std::to_string(layers[l].output_count()); };
  const auto inputs = [&](std::size_t l) { return std::to_string(layers[l].input_count); };
  std::string calls, in = "x0";
  for (std::size_t l = layers.size() == 1 ? 0 : 1; l < layers.size(); ++l) {
    const std::string out = "x" + std::to_string(l + 1);
    calls += "float " + out + "[" + units(l) + "][kBlock];\n";
    if (l == 1) {
      calls += "two_layers<" + inputs(0) + ", " + units(0) + ", " + units(1) + ">(count, " + table(0) + ", " +
               table(1) + ", x0, " + out + ");\n";
    } else {
      if (l > 1) calls += "activate<" + units(l - 1) + ">(count, " + in + ");\n";
      calls +=
          "layer<" + inputs(l) + ", " + units(l) + ">(count, " + table(l) + ", " + in + ", " + out + ");\n";
    }
    in = out;
  }
  *last = in;
  return calls;
}

MaterialCode code_with(const std::string& functions, const std::string& block, const std::string& function,
                       const std::string& argument, const std::string& within = "1e-4f") {
  MaterialCode code;
  code.functions = code_files({"bits", "floats", "conventions", "rows", "width"}) + functions;
  code.block = block;
  code.call = function + "(detail::kConventions, " + argument + "from, to)";
  code.within = within;
  return code;
}

MaterialCode metallic_code(std::string_view file, const std::string& function, const std::string& argument) {
  return code_with(code_files({"specular_texels", file}), "kMetallicBlock", function, argument);
}

MaterialCode formula_code(ClosedFormula formula) {
  switch (formula) {
    case ClosedFormula::kEquation2:
      // Compilers may fuse products, so results may differ slightly. The difference is larger for conversions
      // to the metallic workflow.
      return code_with(code_files({"metallic_to_specular"}), "kSpecularBlock", "metallic_to_specular", "",
                       "4e-6f");
    case ClosedFormula::kEquation3:
      return metallic_code("equation_3", "solve_equation_3", "false, ");
    case ClosedFormula::kEquation3ByAlbedo:
      return metallic_code("equation_3", "solve_equation_3", "true, ");
    case ClosedFormula::kKhronos:
      break;
  }
  return metallic_code("khronos", "solve_khronos", "");
}
MaterialCode formula_code(const Projection& projection) {
  return metallic_code("projection", "project", literal(projection.prior) + ", ");
}
MaterialCode formula_code(const Network& network) {
  return code_with("\ninline constexpr std::size_t kBlock = " + std::to_string(network_block(network)) +
                       ";\n" + network_helpers(network.activation) +
                       network_function("material_network", network) + code_files({"learned"}),
                   "kBlock", "by_network", "");
}

std::string enumerator(remap::workflow_code::WidthParameter width) {
  switch (width) {
    case remap::workflow_code::WidthParameter::kAlpha:
      return "WidthParameter::kAlpha";
    case remap::workflow_code::WidthParameter::kGlossiness:
      return "WidthParameter::kGlossiness";
    case remap::workflow_code::WidthParameter::kRoughness:
      break;
  }
  return "WidthParameter::kRoughness";
}

// Returns numbers as `a,b,c`, with `a_line` numbers on each line. It has no spaces, because tables are large.
template <typename Numbers>
std::string list_text(const Numbers& numbers, std::size_t a_line) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0) text += i % a_line == 0 ? ",\n" : ",";
    if constexpr (std::is_same_v<typename Numbers::value_type, float>)
      text += float_literal(numbers[i]);
    else
      text += std::to_string(numbers[i]);
  }
  return text;
}

template <typename Number>
std::string array_text(const std::string& type, const std::string& name, const std::vector<Number>& numbers,
                       std::size_t a_line) {
  return "inline constexpr " + type + " " + name + "[] = {\n" + list_text(numbers, a_line) + "};\n";
}

std::string width_text(const PackedWarp& warp) {
  const std::array numbers = {warp.least_alpha, warp.largest_alpha, warp.width_start, warp.width_scale};
  return "{" + list_text(numbers, 4) + "}";
}

std::string coordinates_of(const PackedWarp& warp) {
  if (!warp.is_separable())
    return array_text("float", "kWeights", warp.weights, 8) +
           "inline constexpr QuadraticView<kDimension> kCoordinates{kWeights, " + width_text(warp) + "};\n";
  return array_text("float", "kDiffuse", warp.diffuse, 4) +
         array_text("float", "kWidthNodes", warp.width_nodes, 16) +
         "inline constexpr SeparableView<kDimension> kCoordinates{kDiffuse, kWidthNodes, " +
         std::to_string(warp.last_width) + ", " + width_text(warp) + "};\n";
}

std::string grid_text(const PackedWarp& warp) {
  const auto used = [&](const auto& numbers) {
    return list_text(std::span(numbers).first(warp.dimension), 3);
  };
  return "{" + std::to_string(warp.nodes) + ", {" + used(warp.low) + "}, {" + used(warp.scale) + "}}";
}

constexpr std::string_view kBlendedTable = R"(inline constexpr std::size_t kNodes = @count@;
inline constexpr float kLeast[] = {@least@};
inline constexpr float kLargest[] = {@largest@};
@codes@

// The codes as the pass reads them, decoded when they are first asked for.
struct DecodedTable {
  DecodedTable() noexcept { decode_entries(kCodes, kNodes, kLeast, kLargest, entries); }
  float entries[kNodes * kEntryLanes];
};
inline BlendedView<kDimension> table() noexcept {
  static const DecodedTable decoded;
  return {@grid@, decoded.entries};
}
)";

std::string table_of(const PackedWarp& warp, const BlendedNodes& entries) {
  const std::size_t count = entries.codes.size() / kWarpParameters;
  return fill_template(kBlendedTable, {{"count", std::to_string(count)},
                                       {"least", list_text(entries.least, 7)},
                                       {"largest", list_text(entries.largest, 7)},
                                       {"codes", array_text("std::uint8_t", "kCodes", entries.codes, 32)},
                                       {"grid", grid_text(warp)}});
}

constexpr std::string_view kCopiedTable = R"(@palette@
@indices@

inline CopiedView<kDimension> table() noexcept {
  return {@grid@, kIndices, kPalette};
}
)";

std::string table_of(const PackedWarp& warp, const CopiedNodes& entries) {
  return fill_template(kCopiedTable,
                       {{"palette", array_text("float", "kPalette", warp.palette, 7)},
                        {"indices", array_text("std::uint16_t", "kIndices", entries.indices, 20)},
                        {"grid", grid_text(warp)}});
}

}  // namespace

std::string form_code(const ConverterData& converter) {
  const CompactForm& form = converter.form;
  const ConverterInfo& info = converter.info;
  const FormEnds ends = ends_of(info.source.roughness, info.target.roughness, info.roughness);
  const std::string to_alpha = code_of(alpha_of(info.source.roughness, "own")),
                    from_alpha = code_of(native_of(info.target.roughness, "alpha"));
  const bool is_limited = form.alpha_limit || form.specular_limit;
  return fill_template(
      code_file("form"),
      {{"width_min", float_text(ends.width_min)},
       {"width_max", float_text(ends.width_max)},
       {"width_from", float_text(ends.width_from)},
       {"width_to", float_text(ends.width_to)},
       {"specular_min", literal(info.specular.min)},
       {"specular_max", literal(info.specular.max)},
       {"held",
        info.specular.min > 0.0 ? "least(most(s, specular_min), specular_max)" : "least(s, specular_max)"},
       {"alpha_min", float_text(ends.alpha_min)},
       {"least_alpha", float_text(ends.least_alpha)},
       {"pole", float_text(form.pole)},
       {"limits", is_limited ? fill_template(code_file("form_limits"),
                                             {{"alpha_limit", limit_text(form.alpha_limit)},
                                              {"specular_limit", limit_text(form.specular_limit)},
                                              {"turn", float_text(form.hinge.turn)},
                                              {"turn_by_alpha", float_text(form.hinge.turn_by_alpha)},
                                              {"bend", float_text(form.hinge.bend)},
                                              {"spread", float_text(form.hinge.spread)}})
                             : ""},
       {"alpha", depends_on_alpha(form.alpha) ? " alpha" : ""},
       {"alpha_t", form.alpha.size() > 1 ? " t" : ""},
       {"specular_alpha", depends_on_alpha(form.specular) ? " alpha" : ""},
       {"specular_t", form.specular.size() > 1 ? " t" : ""},
       {"alpha_factor", code_of(factor_expression(form.alpha, "alpha", "t"))},
       {"specular_factor", code_of(factor_expression(form.specular, "alpha", "t"))},
       {"to_alpha", to_alpha},
       {"from_alpha", from_alpha},
       {"root",
        (to_alpha + from_alpha).find("root(") == std::string::npos ? "" : std::string(code_file("root"))},
       {"rows", std::string(code_file("form_rows")) + "\n" +
                    std::string(code_file(is_limited ? "form_limited" : "form_free"))}});
}

Network folded(const Network& network) {
  Network result = network;
  Layer& first = result.layers.front();
  for (std::size_t j = 0; j < first.output_count(); ++j)
    for (std::size_t k = 0; k < first.input_count; ++k) {
      double& weight = first.weights[j * first.input_count + k];
      first.biases[j] -= weight * network.inputs[k].scale * network.inputs[k].offset;
      weight *= network.inputs[k].scale;
    }
  Layer& last = result.layers.back();
  for (std::size_t j = 0; j < last.output_count(); ++j) {
    const double range = 1.0 / network.outputs[j].scale;
    for (std::size_t k = 0; k < last.input_count; ++k) last.weights[j * last.input_count + k] *= range;
    last.biases[j] = last.biases[j] * range + network.outputs[j].offset;
  }
  for (Scaling& input : result.inputs) input = {0.0, 1.0, input.pole};
  for (Scaling& output : result.outputs) output = {};
  return result;
}

std::string network_helpers(Activation activation) {
  const std::string_view name = activation_name(activation);
  return (activation == Activation::kRelu ? code_files({name}) : code_files({"tangent", name})) + "\n" +
         fill_template(code_file("layers"), {{"at_once", std::to_string(kUnitsAtOnce)}});
}

std::string network_function(const std::string& name, const Network& network) {
  std::string tables, poles, last;
  for (std::size_t k = 0; k < network.inputs.size(); ++k) {
    if (network.inputs[k].pole == 0.0) continue;
    const std::string row = "x0[" + std::to_string(k) + "][i]";
    poles += "for (std::size_t i = 0; i < count; ++i) " + row + " = " + row + " / (" + row + " + " +
             literal(network.inputs[k].pole) + ");\n";
  }
  for (std::size_t l = 0; l < network.layers.size(); ++l)
    tables += layer_table("k_" + name + "_" + std::to_string(l), network.layers[l]);
  const std::string calls = layer_calls(name, network.layers, &last);
  return "\n" + fill_template(code_file("network"), {{"tables", tables},
                                                     {"name", name},
                                                     {"inputs", std::to_string(network.inputs.size())},
                                                     {"outputs", std::to_string(network.outputs.size())},
                                                     {"poles", poles},
                                                     {"layers", calls},
                                                     {"last", last}});
}

int network_block(const Network& network) {
  std::size_t rows = network.inputs.size() + kUnitsAtOnce, block = 128;
  for (std::size_t l = 1; l < network.layers.size(); ++l) rows += network.layers[l].output_count();
  while (block > 16 && block * rows > kCacheFloats) block /= 2;
  return static_cast<int>(block);
}

MaterialCode material_code(const WorkflowConversion& conversion) {
  const remap::workflow_code::Conventions use = conventions_of(conversion);
  MaterialCode code =
      std::visit([](const auto& formula) { return formula_code(formula); }, conversion.formula);
  code.formula = formula_name(conversion.formula);
  code.constants = "static constexpr float kDielectricF0 = " + float_literal(use.dielectric_f0) +
                   ";  // of the metallic workflow";
  code.functions += "\ninline constexpr Conventions kConventions{" + float_literal(use.dielectric_f0) + ", " +
                    float_literal(use.diffuse_of_albedo) + ", " + (use.diffuse_is_scaled ? "true" : "false") +
                    ", " + enumerator(use.width_in) + ", " + enumerator(use.width_out) + "};\n";
  return code;
}

MaterialCode material_code(const WarpMapFit& fit) {
  const PackedWarp warp = packed(fit.warp);
  const auto table = [&](const auto& entries) { return table_of(warp, entries); };
  const std::string dimension = std::to_string(warp.dimension);
  MaterialCode code;
  code.formula = kWarpKind;
  code.constants =
      "static constexpr const char* kTemplateModel = kTargetModel;\n"
      "// RMS distance in appearance from the exact copy of template texels; shares of the template's "
      "spread, "
      "-1 where unknown.\n"
      "static constexpr double kCopyRmsError = " +
      double_literal(fit.copy_rms_error) + ";\n";
  code.functions =
      code_files({"bits", "floats", "rows", "appearance", warp.is_separable() ? "separable" : "quadratic",
                  warp.is_blended() ? "blended" : "copied", "warp_block"}) +
      "\ninline constexpr std::size_t kDimension = " + dimension + ";\n" + coordinates_of(warp) +
      std::visit(table, fit.warp.table.entries);
  code.block = "kWarpBlock";
  code.call = "warp_block<" + dimension + ">(detail::kCoordinates, detail::table(), from, to)";
  code.within = "1e-4f";
  return code;
}

}  // namespace remap
