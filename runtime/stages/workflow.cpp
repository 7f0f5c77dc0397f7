#include "remap/workflow.hpp"

#include <array>

#include "core/number_text.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

constexpr double kLargestDielectricF0 = 0.9;

struct Name {
  std::string_view operator()(const Equation2&) const { return "equation-2"; }
  std::string_view operator()(const Projection&) const { return "projection"; }
  std::string_view operator()(const Equation3&) const { return "equation-3"; }
  std::string_view operator()(const KhronosSolver&) const { return "khronos"; }
  std::string_view operator()(const LearnedNetwork&) const { return "network"; }
};

struct Text {
  std::string operator()(const Equation2&) const {
    return "equation (2) of Sztrajman et al. 2019, exact: every metallic material is a specular one";
  }
  std::string operator()(const Projection& projection) const {
    return "least difference of the pictures over base color and metallic, prior " +
           number_text(projection.prior);
  }
  std::string operator()(const Equation3& equation) const {
    return std::string("equation (3) of Sztrajman et al. 2019, metallic by the mean over the channels") +
           (equation.mean == MetallicMean::kAlbedo ? ", weighted by albedo" : "");
  }
  std::string operator()(const KhronosSolver&) const {
    return "the solver of KHR_materials_pbrSpecularGlossiness (Khronos Group 2017)";
  }
  std::string operator()(const LearnedNetwork& learned) const {
    std::string sizes = std::to_string(learned.network.inputs.size());
    for (const Layer& layer : learned.network.layers) sizes += " x " + std::to_string(layer.output_count());
    return "a network of " + sizes + " (" + std::string(activation_name(learned.network.activation)) +
           "), learned from metallic materials as in section 8 of Sztrajman et al. 2019";
  }
};

constexpr std::size_t kNetworkInputs = 6, kNetworkOutputs = 4;

void require_network(const LearnedNetwork& learned, const std::string& place) {
  const std::size_t inputs = learned.network.inputs.size(), outputs = learned.network.outputs.size();
  if (inputs == kNetworkInputs && outputs == kNetworkOutputs && !learned.network.layers.empty()) return;
  throw Error(ErrorKind::kInput,
              place + ": a network of " + std::to_string(inputs) + " inputs and " + std::to_string(outputs) +
                  " outputs (diffuse and specular are 6 inputs, base color and metallic 4 outputs)");
}

void require_width(RoughnessConvention width, const std::string& place) {
  if (width == RoughnessConvention::kRoughness || width == RoughnessConvention::kGlossiness ||
      width == RoughnessConvention::kAlpha)
    return;
  throw Error(ErrorKind::kInput, place + ": a workflow cannot hold its roughness as " +
                                     std::string(convention_name(width)) +
                                     " (choose roughness, glossiness or alpha)");
}

std::string width_meaning(RoughnessConvention width) {
  switch (width) {
    case RoughnessConvention::kAlpha:
      return "microfacet width";
    case RoughnessConvention::kGlossiness:
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
          {std::string(convention_name(workflow.width)), 1, width_meaning(workflow.width)}};
}

std::vector<MaterialParameter> parameters(const MetallicWorkflow& workflow) {
  return {{"base_color", 3, "albedo of the dielectric and F0 of the metal, linear"},
          {"metallic", 1, "share of metal"},
          {std::string(convention_name(workflow.width)), 1, width_meaning(workflow.width)}};
}

}  // namespace

std::string_view formula_name(const WorkflowFormula& formula) { return std::visit(Name{}, formula); }

std::string formula_text(const WorkflowFormula& formula) { return std::visit(Text{}, formula); }

void require_valid(const WorkflowConversion& conversion, const std::string& place) {
  require_width(conversion.specular.width, place);
  require_width(conversion.metallic.width, place);
  const double f0 = conversion.metallic.dielectric_f0;
  if (!(f0 >= 0.0 && f0 <= kLargestDielectricF0))
    throw Error(ErrorKind::kInput, place + ": dielectric F0 " + number_text(f0) + " is out of range (0 to " +
                                       number_text(kLargestDielectricF0) + ")");
  if (const auto* projection = std::get_if<Projection>(&conversion.formula);
      projection != nullptr && !(projection->prior >= 0.0 && projection->prior <= kLargestPrior))
    throw Error(ErrorKind::kInput, place + ": prior " + number_text(projection->prior) +
                                       " is out of range (0 to " + number_text(kLargestPrior) + ")");
  if (const auto* learned = std::get_if<LearnedNetwork>(&conversion.formula))
    require_network(*learned, place);
  if (!std::holds_alternative<KhronosSolver>(conversion.formula)) return;
  const bool scaled = conversion.specular.diffuse == DiffuseConvention::kScaled &&
                      conversion.metallic.diffuse == DiffuseConvention::kScaled;
  if (!scaled || f0 == 0.0)
    throw Error(ErrorKind::kInput,
                place +
                    ": Khronos' solver requires a dielectric F0 above 0 and scaled diffuse "
                    "on both sides");
}

std::vector<MaterialParameter> source_parameters(const WorkflowConversion& conversion) {
  return conversion.is_to_metallic() ? parameters(conversion.specular) : parameters(conversion.metallic);
}

std::vector<MaterialParameter> target_parameters(const WorkflowConversion& conversion) {
  return conversion.is_to_metallic() ? parameters(conversion.metallic) : parameters(conversion.specular);
}

}  // namespace remap
