// This file describes fits of every kind as data of a header.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "emit/header_data.hpp"
#include "reference/workflow_conversion.hpp"
#include "remap/converter.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

// Returns words for a comment in the header.
const char* meaning_of(RoughnessEncoding encoding) {
  switch (encoding) {
    case RoughnessEncoding::kAlpha:
      break;
    case RoughnessEncoding::kRoughness:
      return "perceptual roughness, square root of the microfacet width, (0, 1]";
    case RoughnessEncoding::kExponent:
      return "Phong exponent, 2 / alpha^2 - 2 of the microfacet width, from 0";
    case RoughnessEncoding::kGlossiness:
      return "1 - square root of the microfacet width, [0, 1)";
    case RoughnessEncoding::kSquared:
      return "square of the microfacet width, (0, 1]";
  }
  return "microfacet width, (0, 1]";
}

std::string error_text(const std::string& name, const ErrorFigures& figures) {
  return name + " rms " + two_digits(figures.rms) + ", 99 % " + two_digits(figures.p99) + ", max " +
         two_digits(figures.max);
}

std::string range_text(const std::string& name, const Range& range) {
  return name + " " + number_text(range.min) + " to " + number_text(range.max);
}

// Returns how much pictures differ, and where the numbers come from, for readers who do not know remap.
std::string provenance(const Fit& fit) {
  std::string text;
  for (const std::string& remark : fit.remarks) text += remark + "\n";
  if (fit.pictures)
    text += "Pictures of spheres differ by " + fixed(fit.pictures->rmse, 1) +
            " % of white on average (root mean square of display values), by " +
            fixed(fit.copied_pictures->rmse, 1) +
            " %\nwhere the numbers are copied: lights and materials that had no part in the fit.\n";
  if (!fit.table.name.empty()) text += "Table " + fit.table.name + ", sha256 " + fit.table.sha256 + ";\n";
  if (!fit.table.comment("objective").empty())
    text += "objective " + fit.table.comment("objective") + " (lights " + fit.table.comment("lights") +
            ", weighting " + fit.table.comment("weighting") + "), " + fit.table.comment("resolution") +
            " pixels squared, by " + fit.table.comment("renderer") + ".\n";
  text += "Fit: " + kind_name(fit.mapping) + ", " + std::to_string(number_count(fit.converter->form)) +
          " numbers";
  if (fit.split.trained_rows + fit.split.held_out_rows != 0)
    text += ", seed " + std::to_string(fit.split.seed) + ", " + std::to_string(fit.split.trained_rows) +
            " rows trained, " + std::to_string(fit.split.held_out_rows) + " held out";
  text += ".\n";
  if (fit.has_errors())
    text += std::string("Error ") +
            (fit.split.held_out_rows != 0 ? "on the rows held out: " : "of its steps together: ") +
            error_text("alpha", fit.alpha_error) + ";\n" +
            error_text(fit.target.specular, fit.specular_error) + ".\n";
  else
    text += "Its error is not known.\n";
  return text + "The code is within " + two_digits(fit.converter->alpha_bound) + " of the fit in alpha and " +
         two_digits(fit.converter->specular_bound) + " in specular (proven).\nCovers " +
         range_text("alpha", fit.domain.alpha) + ", " + range_text(fit.source.specular, fit.domain.specular) +
         ".";
}

HeaderEnd end_of(const ModelSide& side) {
  return {
      side.model,
      std::string(encoding_name(side.roughness)),
      {{"width", 1, meaning_of(side.roughness)},
       {"specular", 1,
        side.specular == "f0" ? "reflectance at normal incidence, linear" : "specular reflectance, linear"}}};
}

HeaderEnd end_of(const std::string& model, const std::string& workflow, std::string_view diffuse,
                 std::vector<MaterialParameter> parameters) {
  for (MaterialParameter& parameter : parameters) parameter.meaning += ", 0 to 1";
  const std::string width = std::exchange(parameters.back().name, "width");
  return {model, width, std::move(parameters), workflow, std::string(diffuse)};
}

std::string title_of(const HeaderEnd& source, const HeaderEnd& target) {
  return "Materials of " + source.model + " (" + source.workflow + " workflow) as materials of " +
         target.model + " (" + target.workflow + " workflow).";
}

// Returns metallic materials over the range: dielectrics, metals, blends, dark and bright.
std::vector<MetallicMaterial> golden_materials() {
  return {{{0.5f, 0.25f, 0.125f}, 0.0f, 0.5f},           {{1.0f, 0.75f, 0.375f}, 1.0f, 0.25f},
          {{0.75f, 0.5f, 0.25f}, 0.5f, 0.75f},           {{0.25f, 0.5f, 0.875f}, 0.25f, 0.375f},
          {{0.875f, 0.125f, 0.5f}, 0.75f, 1.0f},         {{0.125f, 0.125f, 0.125f}, 0.0f, 0.125f},
          {{0.9375f, 0.9375f, 0.9375f}, 0.125f, 0.625f}, {{0.5f, 0.5f, 0.5f}, 1.0f, 0.0f}};
}

std::vector<float> values_of(const MetallicMaterial& material) {
  const auto& [color, metallic, width] = material;
  return {color[0], color[1], color[2], metallic, width};
}
std::vector<float> values_of(const SpecularMaterial& material) {
  const auto& [diffuse, specular, width] = material;
  return {diffuse[0], diffuse[1], diffuse[2], specular[0], specular[1], specular[2], width};
}

GoldenValues golden_values(const WorkflowConversion& conversion, const MetallicMaterial& metallic) {
  WorkflowConversion forward = conversion;
  forward.formula = ClosedFormula::kEquation2;
  SpecularMaterial specular = to_specular(forward, metallic);
  if (!conversion.is_to_metallic()) return {values_of(metallic), values_of(specular), {}};
  // Make the last channel of this material darker, so that no metallic material can express it.
  if (metallic.metallic == 0.5f) specular.specular[2] *= 0.5f;
  return {values_of(specular), values_of(to_metallic(conversion, specular)), {}};
}

std::string training_lines(const NetworkTraining& training) {
  const auto text = [](const ErrorFigures& figures) {
    return "rms " + two_digits(figures.rms) + ", max " + two_digits(figures.max);
  };
  return "Table " + training.table.name + ", sha256 " + training.table.sha256 + "; seed " +
         std::to_string(training.split.seed) + ".\nError on unseen rows: base color " +
         text(training.base_color) + "; metallic " + text(training.metallic) + ".\n";
}

std::string provenance(const WorkflowFit& fit) {
  std::string text = "By " + formula_text(fit.conversion.formula) + ".\n";
  if (fit.training) text += training_lines(*fit.training);
  for (const std::string& remark : fit.remarks) text += remark + "\n";
  text.pop_back();
  return text;
}

// Returns a texel from the whole range. It is the same everywhere, because it consists of fractions of
// multiples of irrational numbers.
WarpTexel candidate(std::size_t number) {
  constexpr std::array<double, kWarpParameters> kSteps = {0.7548777, 0.5698403, 0.4301597, 0.8191725,
                                                          0.6710436, 0.5497005, 0.4503046};
  WarpTexel texel;
  for (std::size_t p = 0; p < texel.size(); ++p) {
    const double place = static_cast<double>(number + 1) * kSteps[p];
    texel[p] = static_cast<float>(std::floor((place - std::floor(place)) * 1024.0) / 1024.0);
  }
  return texel;
}

// Returns how far a texel is, in nodes, from places where another node becomes the closest. Blended tables
// have no such places, so the result is 1.
double distance_to_tie(const CompiledWarp& warp, const WarpTexel& texel) {
  double distance = 1.0;
  if (!std::holds_alternative<CopiedNodes>(warp.table.entries)) return distance;
  const auto position = node_position_of(warp, texel);
  for (std::size_t k = 0; k < warp.coordinates.dimension; ++k)
    distance = std::min(distance, std::fabs(position[k] - std::floor(position[k]) - 0.5));
  return distance;
}

std::vector<GoldenValues> golden_values(const CompiledWarp& warp) {
  constexpr std::size_t kTexels = 8, kCandidates = 512;
  std::vector<GoldenValues> golden;
  for (std::size_t i = 0; i < kCandidates && golden.size() < kTexels; ++i) {
    const WarpTexel texel = candidate(i);
    if (distance_to_tie(warp, texel) < 0.01) continue;
    const WarpTexel result = evaluate_warp(warp, texel);
    golden.push_back({{texel.begin(), texel.end()}, {result.begin(), result.end()}, {}});
  }
  return golden;
}

std::string provenance(const WarpMapFit& fit) {
  const bool copied = std::holds_alternative<CopiedNodes>(fit.warp.table.entries);
  std::string text = std::string("By an appearance warp (An et al. 2011): reflectances of a template, ") +
                     (copied ? "copied" : "blended between\nnodes of a table") + ".\n";
  for (const auto& [key, value] : fit.method) text += key + ": " + value + "\n";
  if (fit.copy_rms_error >= 0.0)
    text += "From an exact copy of template texels: " + percent(fit.copy_rms_error) +
            " of the template's spread (RMS).\n";
  for (const std::string& remark : fit.remarks) text += remark + "\n";
  text.pop_back();
  return text;
}

}  // namespace

std::string two_digits(double error) { return number_text(rounded_up(error, 2)); }

const ConverterData& require_converter(const Fit& fit) {
  if (fit.converter) return *fit.converter;
  throw numeric_error(fit.id + ": has no converter, because it could not be lowered (remapc fit --lower)");
}

HeaderData describe(const Fit& fit) {
  const ConverterData& converter = require_converter(fit);
  HeaderData data;
  data.id = fit.id;
  data.title = fit.source.model + " to " + fit.target.model +
               ": which parameters of the second give the same picture as those of the first.";
  data.provenance = provenance(fit);
  data.source = end_of(fit.source);
  data.target = end_of(fit.target);
  for (const GoldenTexel& g : converter.golden)
    data.golden.push_back(
        {{g.width, g.specular}, {g.width_out, g.specular_out}, {g.width_within, g.specular_within}});
  data.code = converter;
  return data;
}

HeaderData describe(const WorkflowFit& fit) {
  WorkflowConversion conversion = fit.conversion;
  require_valid(conversion, fit.id);
  HeaderData data;
  data.id = fit.id;
  const bool to_metallic = conversion.is_to_metallic();
  data.source =
      end_of(conversion.specular.model, "specular", diffuse_convention_name(conversion.specular.diffuse),
             to_metallic ? source_parameters(conversion) : target_parameters(conversion));
  data.target =
      end_of(conversion.metallic.model, "metallic", diffuse_convention_name(conversion.metallic.diffuse),
             to_metallic ? target_parameters(conversion) : source_parameters(conversion));
  if (!to_metallic) std::swap(data.source, data.target);
  data.title = title_of(data.source, data.target);
  data.provenance = provenance(fit);
  for (const MetallicMaterial& material : golden_materials())
    data.golden.push_back(golden_values(conversion, material));
  if (auto* network = std::get_if<Network>(&conversion.formula)) *network = folded(*network);
  data.code = std::move(conversion);
  return data;
}

HeaderData describe(const WarpMapFit& fit) {
  require_valid(fit.warp, fit.id);
  const std::vector<MaterialParameter> parameters = {
      {"diffuse", 3, "diffuse reflectance"},
      {"specular", 3, "specular reflectance at normal incidence, or scale"},
      {"alpha", 1, "microfacet width"}};
  HeaderData data;
  data.id = fit.id;
  data.source = end_of(fit.source_model, "specular", "plain", parameters);
  data.target = end_of(fit.template_model, "specular", "plain", parameters);
  data.title = title_of(data.source, data.target);
  data.provenance = provenance(fit);
  data.golden = golden_values(fit.warp);
  data.code = fit;
  return data;
}

}  // namespace remap
