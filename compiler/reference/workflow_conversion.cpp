#include "reference/workflow_conversion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "core/number_text.hpp"

#if defined(__clang__)  // silences the warning about loops that cannot be vectorised
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wpass-failed"
#endif
namespace remap::workflow_code {
#include "reference/code/equation_3.inc"
#include "reference/code/khronos.inc"
}  // namespace remap::workflow_code
#if defined(__clang__)
#pragma clang diagnostic pop
#endif

namespace remap {
namespace {

namespace code = workflow_code;

std::string_view name_of(ClosedFormula formula) {
  switch (formula) {
    case ClosedFormula::kEquation2:
      return "equation-2";
    case ClosedFormula::kKhronos:
      return "khronos";
    default:
      return "equation-3";
  }
}
std::string_view name_of(const Projection&) { return "projection"; }
std::string_view name_of(const Network&) { return "network"; }

std::string text_of(ClosedFormula formula) {
  constexpr const char* kEquation3 =
      "equation (3) of Sztrajman et al. 2019, metallic by the mean over the channels";
  switch (formula) {
    case ClosedFormula::kEquation2:
      return "equation (2) of Sztrajman et al. 2019, exact: every metallic material is a specular one";
    case ClosedFormula::kEquation3:
      return kEquation3;
    case ClosedFormula::kEquation3ByAlbedo:
      return std::string(kEquation3) + ", weighted by albedo";
    case ClosedFormula::kKhronos:
      break;
  }
  return "the solver of KHR_materials_pbrSpecularGlossiness (Khronos Group 2017)";
}
std::string text_of(const Projection& projection) {
  return "least difference of the pictures over base color and metallic, prior " +
         number_text(projection.prior);
}
std::string text_of(const Network& network) {
  std::string sizes = std::to_string(network.inputs.size());
  for (const Layer& layer : network.layers) sizes += " x " + std::to_string(layer.output_count());
  return "a network of " + sizes + " (" + std::string(activation_name(network.activation)) +
         "), learned from metallic materials as in section 8 of Sztrajman et al. 2019";
}

constexpr std::size_t kNetworkInputs = 6, kNetworkOutputs = 4;

void require_network(const Network& network, const std::string& context) {
  const std::size_t inputs = network.inputs.size(), outputs = network.outputs.size();
  if (inputs == kNetworkInputs && outputs == kNetworkOutputs && !network.layers.empty()) return;
  throw input_error(context + ": a network of " + std::to_string(inputs) + " inputs and " +
                    std::to_string(outputs) +
                    " outputs (diffuse and specular are 6 inputs, base color and metallic 4 outputs)");
}

std::string width_meaning(RoughnessEncoding width) {
  switch (width) {
    case RoughnessEncoding::kAlpha:
      return "microfacet width";
    case RoughnessEncoding::kGlossiness:
      return "1 - square root of the microfacet width";
    default:
      return "square root of the microfacet width";
  }
}

std::vector<MaterialParameter> parameters(const SpecularWorkflow& workflow) {
  return {{"diffuse", 3,
           workflow.diffuse == DiffuseConvention::kPlain
               ? "diffuse reflectance, linear"
               : "diffuse reflectance of what the specular lobe leaves, linear"},
          {"specular", 3, "reflectance at normal incidence, linear"},
          {std::string(encoding_name(workflow.width)), 1, width_meaning(workflow.width)}};
}

std::vector<MaterialParameter> parameters(const MetallicWorkflow& workflow) {
  return {{"base_color", 3, "albedo of the dielectric and F0 of the metal, linear"},
          {"metallic", 1, "share of metal"},
          {std::string(encoding_name(workflow.width)), 1, width_meaning(workflow.width)}};
}

template <std::size_t Count, typename Pointer>
std::array<Pointer, Count> rows(std::span<const Pointer> given, const char* what) {
  if (given.size() != Count)
    throw usage_error(std::string("workflow conversion: ") + std::to_string(given.size()) + " rows of " +
                      what + " (give " + std::to_string(Count) + ")");
  std::array<Pointer, Count> all{};
  std::copy(given.begin(), given.end(), all.begin());
  return all;
}

// Each block_by() converts a block to metallic by a formula. It returns the number of texels outside.
using SpecularBlock = std::array<const float*, 7>;
using MetallicBlock = std::array<float*, 5>;

std::size_t block_by(ClosedFormula formula, const code::Conventions& use, const SpecularBlock& in,
                     const MetallicBlock& out) {
  switch (formula) {
    case ClosedFormula::kEquation2:
      return 0;  // it leads to the specular workflow only
    case ClosedFormula::kKhronos:
      return code::solve_khronos(use, in, out);
    default:
      return code::solve_equation_3(use, formula == ClosedFormula::kEquation3ByAlbedo, in, out);
  }
}

std::size_t block_by(const Projection& projection, const code::Conventions& use, const SpecularBlock& in,
                     const MetallicBlock& out) {
  return code::project(use, static_cast<float>(projection.prior), in, out);
}

// Interprets the network in double precision, texel by texel.
std::size_t block_by(const Network& network, const code::Conventions& use, const SpecularBlock& in,
                     const MetallicBlock& out) {
  code::ClampedBlock<7, code::kMetallicBlock> block;
  const std::size_t outside = code::hold(in, block, std::make_index_sequence<7>());
  for (std::size_t i = 0; i < code::kMetallicBlock; ++i) {
    std::vector<double> values;
    bool is_nan = false;
    for (std::size_t r = 0; r < 6; ++r) {
      values.push_back(static_cast<double>(block.row[r][i]));
      is_nan = is_nan || std::isnan(block.row[r][i]);
    }
    const std::vector<double> outputs = network_outputs(network, std::move(values));
    for (std::size_t r = 0; r < outputs.size(); ++r)
      out[r][i] = is_nan ? std::numeric_limits<float>::quiet_NaN()
                         : static_cast<float>(std::clamp(outputs[r], 0.0, 1.0));
  }
  code::write_width(use, block, out[4]);
  return outside;
}

void require_direction(const WorkflowConversion& conversion, bool to_metallic) {
  if (conversion.is_to_metallic() == to_metallic) return;
  throw usage_error(std::string("workflow conversion: ") + std::string(formula_name(conversion.formula)) +
                    " leads from " + conversion.source_model() + " to " + conversion.target_model() +
                    ", not the other way (call the other function)");
}

bool has_value_beyond(const SpecularMaterial& material) {
  const auto is_beyond = [](float value) { return !(value >= 0.0f && value <= 1.0f); };
  return std::ranges::any_of(material.diffuse, is_beyond) ||
         std::ranges::any_of(material.specular, is_beyond) || is_beyond(material.width);
}

float width_of(const code::Texel& texel, const code::Conventions& use) {
  std::array<float, code::kMetallicSamples> errors{};
  code::sample_errors(texel, use, errors.data());
  return code::metallic_uncertainty(errors.data(), code::good_error(texel, use));
}

}  // namespace

std::string_view formula_name(const WorkflowFormula& formula) {
  return std::visit([](const auto& kind) { return name_of(kind); }, formula);
}

std::string formula_text(const WorkflowFormula& formula) {
  return std::visit([](const auto& kind) { return text_of(kind); }, formula);
}

void require_valid(const WorkflowConversion& conversion, const std::string& context) {
  require_valid(conversion.specular, conversion.metallic, context);
  if (const auto* projection = std::get_if<Projection>(&conversion.formula))
    require_prior(projection->prior, context);
  if (const auto* network = std::get_if<Network>(&conversion.formula)) require_network(*network, context);
  if (!is_formula(conversion.formula, ClosedFormula::kKhronos)) return;
  const bool scaled = conversion.specular.diffuse == DiffuseConvention::kScaled &&
                      conversion.metallic.diffuse == DiffuseConvention::kScaled;
  if (!scaled || conversion.metallic.dielectric_f0 == 0.0)
    throw input_error(context +
                      ": formula khronos needs a dielectric F0 above 0 and scaled diffuse on both sides");
}

std::vector<MaterialParameter> source_parameters(const WorkflowConversion& conversion) {
  return conversion.is_to_metallic() ? parameters(conversion.specular) : parameters(conversion.metallic);
}

std::vector<MaterialParameter> target_parameters(const WorkflowConversion& conversion) {
  return conversion.is_to_metallic() ? parameters(conversion.metallic) : parameters(conversion.specular);
}

workflow_code::Conventions conventions_of(const WorkflowConversion& conversion) {
  return conventions_of(conversion.specular, conversion.metallic, conversion.is_to_metallic());
}

std::size_t convert_workflow(const WorkflowConversion& conversion, std::size_t count,
                             std::span<const float* const> in, std::span<float* const> out) {
  require_valid(conversion, "workflow conversion");
  const code::Conventions use = conventions_of(conversion);
  if (!conversion.is_to_metallic()) {
    const auto sources = rows<5>(in, "metallic materials");
    const auto targets = rows<7>(out, "specular materials");
    return code::convert_rows<code::kSpecularBlock>(
        count, sources, targets,
        [&](const auto& from, const auto& to) { return code::metallic_to_specular(use, from, to); });
  }
  const auto sources = rows<7>(in, "specular materials");
  const auto targets = rows<5>(out, "metallic materials");
  return code::convert_rows<code::kMetallicBlock>(
      count, sources, targets, [&](const auto& from, const auto& to) {
        return std::visit([&](const auto& kind) { return block_by(kind, use, from, to); },
                          conversion.formula);
      });
}

MetallicMaterial to_metallic(const WorkflowConversion& conversion, const SpecularMaterial& material) {
  require_direction(conversion, true);
  const auto& [diffuse, specular, width] = material;
  MetallicMaterial result;
  const std::array<const float*, 7> in = {&diffuse[0],  &diffuse[1],  &diffuse[2], &specular[0],
                                          &specular[1], &specular[2], &width};
  auto& color = result.base_color;
  const std::array<float*, 5> out = {&color[0], &color[1], &color[2], &result.metallic, &result.width};
  convert_workflow(conversion, 1, in, out);
  return result;
}

SpecularMaterial to_specular(const WorkflowConversion& conversion, const MetallicMaterial& material) {
  require_direction(conversion, false);
  SpecularMaterial result;
  const auto& color = material.base_color;
  const std::array<const float*, 5> in = {&color[0], &color[1], &color[2], &material.metallic,
                                          &material.width};
  auto& [diffuse, specular, width] = result;
  const std::array<float*, 7> out = {&diffuse[0],  &diffuse[1],  &diffuse[2], &specular[0],
                                     &specular[1], &specular[2], &width};
  convert_workflow(conversion, 1, in, out);
  return result;
}

MetallicDiagnosis diagnose(const WorkflowConversion& conversion, const SpecularMaterial& material,
                           const MetallicMaterial& result) {
  require_valid(conversion, "diagnosis");
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  if (has_nan(material) || std::isnan(result.metallic)) return {kNan, kNan, true};
  const code::Conventions use = conventions_of(conversion.specular, conversion.metallic, true);
  const code::Texel texel = texel_of(use, material);
  const auto& [red, green, blue] = result.base_color;
  return {code::residual_of(texel, use, result.metallic, red, green, blue), width_of(texel, use),
          has_value_beyond(material) || code::is_clamped(texel, use, result.metallic)};
}

}  // namespace remap
