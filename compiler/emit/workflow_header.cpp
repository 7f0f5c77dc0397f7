// The header of an analytic fit: the text of its formulas, with its conventions.
#include "emit/code_text.hpp"
#include "emit/emit.hpp"
#include "emit/mapping_code.hpp"
#include "emit/material_header.hpp"
#include "text/number_text.hpp"
#include "workflow/conversion.hpp"

namespace remapc {
namespace {

using remap::WorkflowConversion;

// What a formula adds to the header.
struct FormulaCode {
  std::string text;
  std::string block;  // its block size
  std::string call;
};

struct CodeOf {
  FormulaCode operator()(const remap::Equation2&) const {
    return {std::string(kMetallicToSpecularText), "kSpecularBlock",
            "metallic_to_specular(detail::kConventions, from, to)"};
  }
  FormulaCode operator()(const remap::Projection& projection) const {
    return to_metallic(kProjectionText,
                       "project(detail::kConventions, " + literal(projection.prior) + ", from, to)");
  }
  FormulaCode operator()(const remap::Equation3& equation) const {
    const bool by_albedo = equation.mean == remap::MetallicMean::kAlbedo;
    return to_metallic(kEquation3Text, std::string("solve_equation_3(detail::kConventions, ") +
                                           (by_albedo ? "true" : "false") + ", from, to)");
  }
  FormulaCode operator()(const remap::KhronosSolver&) const {
    return to_metallic(kKhronosText, "solve_khronos(detail::kConventions, from, to)");
  }
  FormulaCode operator()(const remap::LearnedNetwork& learned) const {
    const remap::Network& network = learned.network;
    return {"inline constexpr std::size_t kBlock = " + std::to_string(network_block(network)) + ";\n" +
                network_helpers(network.activation) + network_function("material_network", network) + "\n" +
                std::string(kLearnedText),
            "kBlock", "by_network(detail::kConventions, from, to)"};
  }

 private:
  static FormulaCode to_metallic(std::string_view text, const std::string& call) {
    return {std::string(kSpecularTexelsText) + "\n" + std::string(text), "kMetallicBlock", call};
  }
};

std::string width_enumerator(remap::RoughnessConvention width) {
  switch (width) {
    case remap::RoughnessConvention::kAlpha:
      return "WidthParameter::kAlpha";
    case remap::RoughnessConvention::kGlossiness:
      return "WidthParameter::kGlossiness";
    default:
      return "WidthParameter::kRoughness";
  }
}

std::string conventions_text(const WorkflowConversion& conversion) {
  const double f0 = conversion.metallic.dielectric_f0;
  const bool scaled = conversion.metallic.diffuse == remap::DiffuseConvention::kScaled;
  const std::string specular = width_enumerator(conversion.specular.width),
                    metallic = width_enumerator(conversion.metallic.width);
  const bool to_metallic = conversion.is_to_metallic();
  return literal(f0) + ", " + literal(scaled ? 1.0 - f0 : 1.0) + ", " +
         (conversion.specular.diffuse == remap::DiffuseConvention::kScaled ? "true" : "false") + ", " +
         (to_metallic ? specular : metallic) + ", " + (to_metallic ? metallic : specular);
}

// Metallic materials over the range: dielectrics, metals, blends, dark and bright.
std::vector<remap::MetallicMaterial> golden_materials() {
  return {{{0.5f, 0.25f, 0.125f}, 0.0f, 0.5f},           {{1.0f, 0.75f, 0.375f}, 1.0f, 0.25f},
          {{0.75f, 0.5f, 0.25f}, 0.5f, 0.75f},           {{0.25f, 0.5f, 0.875f}, 0.25f, 0.375f},
          {{0.875f, 0.125f, 0.5f}, 0.75f, 1.0f},         {{0.125f, 0.125f, 0.125f}, 0.0f, 0.125f},
          {{0.9375f, 0.9375f, 0.9375f}, 0.125f, 0.625f}, {{0.5f, 0.5f, 0.5f}, 1.0f, 0.0f}};
}

GoldenRows golden_rows(const WorkflowConversion& conversion) {
  const std::size_t in_rows = row_count(source_parameters(conversion)),
                    out_rows = row_count(target_parameters(conversion));
  const auto materials = golden_materials();
  GoldenRows golden{std::vector<std::vector<float>>(in_rows), std::vector<std::vector<float>>(out_rows)};
  WorkflowConversion there = conversion;
  there.formula = remap::Equation2{};
  for (const remap::MetallicMaterial& material : materials) {
    const auto& color = material.base_color;
    std::vector<float> values = {color[0], color[1], color[2], material.metallic, material.width};
    if (conversion.is_to_metallic()) {
      const auto [diffuse, specular, width] = to_specular(there, material);
      values = {diffuse[0], diffuse[1], diffuse[2], specular[0], specular[1], specular[2], width};
      // Off what metallic can say: the last channel is darker.
      if (material.metallic == 0.5f) values[5] *= 0.5f;
    }
    for (std::size_t r = 0; r < in_rows; ++r) golden.in[r].push_back(values[r]);
  }
  std::vector<const float*> in;
  std::vector<float*> out;
  for (const auto& row : golden.in) in.push_back(row.data());
  for (auto& row : golden.out) out.push_back((row.resize(materials.size()), row.data()));
  remap::convert_workflow(conversion, materials.size(), in, out);
  return golden;
}

std::string training_lines(const remap::NetworkTraining& training) {
  const auto text = [](const remap::ErrorFigures& figures) {
    return "rms " + remap::number_text(remap::rounded_up(figures.rms, 2)) + ", max " +
           remap::number_text(remap::rounded_up(figures.max, 2));
  };
  return "// Table " + training.table.name + ", sha256 " + training.table.sha256 + "; seed " +
         std::to_string(training.split.seed) + ".\n// Error on unseen rows: base color " +
         text(training.base_color) + "; metallic " + text(training.metallic) + ".\n";
}

std::string provenance(const remap::WorkflowFit& fit) {
  std::string text = "// By " + formula_text(fit.conversion.formula) + ".\n";
  if (fit.training) text += training_lines(*fit.training);
  for (const std::string& remark : fit.remarks) text += "// " + remark + "\n";
  text.pop_back();
  return text;
}

}  // namespace

std::string emit_header(const remap::WorkflowFit& fit) {
  const WorkflowConversion& conversion = fit.conversion;
  require_valid(conversion, fit.id);
  const bool to_metallic = conversion.is_to_metallic();
  const std::string specular(diffuse_convention_name(conversion.specular.diffuse)),
      metallic(diffuse_convention_name(conversion.metallic.diffuse));
  const FormulaCode code = std::visit(CodeOf{}, conversion.formula);
  MaterialHeader header;
  header.id = fit.id;
  header.formula = formula_name(conversion.formula);
  header.provenance = provenance(fit);
  header.source = {conversion.source_model(), to_metallic ? "specular" : "metallic",
                   to_metallic ? specular : metallic, source_parameters(conversion)};
  header.target = {conversion.target_model(), to_metallic ? "metallic" : "specular",
                   to_metallic ? metallic : specular, target_parameters(conversion)};
  header.constants = "inline constexpr float kDielectricF0 = " + literal(conversion.metallic.dielectric_f0) +
                     ";  // of the metallic workflow";
  header.code = code_text({kFloatsText, kConventionsText, kRowsText, kWidthText, code.text}) +
                "\ninline constexpr Conventions kConventions{" + conventions_text(conversion) + "};\n";
  header.block = code.block;
  header.call = code.call;
  header.within = to_metallic ? "1e-4f" : "4e-6f";  // fused products; towards metallic they are amplified
  header.golden = golden_rows(conversion);
  return material_header(header);
}

}  // namespace remapc
