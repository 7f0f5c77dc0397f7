#include "stages/workflow_conventions.hpp"

#include "core/errors.hpp"
#include "core/number_text.hpp"

namespace remap {
namespace {

namespace code = workflow_code;

constexpr double kLargestDielectricF0 = 0.9;

void require_width(RoughnessEncoding width, const std::string& context) {
  if (width == RoughnessEncoding::kRoughness || width == RoughnessEncoding::kGlossiness ||
      width == RoughnessEncoding::kAlpha)
    return;
  throw input_error(context + ": a workflow cannot store its roughness as " +
                    std::string(encoding_name(width)) + " (choose roughness, glossiness or alpha)");
}

}  // namespace

void require_valid(const SpecularWorkflow& specular, const MetallicWorkflow& metallic,
                   const std::string& context) {
  require_width(specular.width, context);
  require_width(metallic.width, context);
  const double f0 = metallic.dielectric_f0;
  if (!(f0 >= 0.0 && f0 <= kLargestDielectricF0))
    throw input_error(context + ": dielectric F0 " + number_text(f0) + " is out of range (0 to " +
                      number_text(kLargestDielectricF0) + ")");
}

void require_prior(double prior, const std::string& context) {
  if (!(prior >= 0.0 && prior <= kLargestPrior))
    throw input_error(context + ": prior " + number_text(prior) + " is out of range (0 to " +
                      number_text(kLargestPrior) + ")");
}

workflow_code::WidthParameter width_parameter(RoughnessEncoding width) {
  if (width == RoughnessEncoding::kAlpha) return code::WidthParameter::kAlpha;
  return width == RoughnessEncoding::kGlossiness ? code::WidthParameter::kGlossiness
                                                 : code::WidthParameter::kRoughness;
}

workflow_code::Conventions conventions_of(const SpecularWorkflow& specular, const MetallicWorkflow& metallic,
                                          bool to_metallic) {
  const double f0 = metallic.dielectric_f0;
  const bool scaled = metallic.diffuse == DiffuseConvention::kScaled;
  const auto specular_width = width_parameter(specular.width),
             metallic_uncertainty = width_parameter(metallic.width);
  return {static_cast<float>(f0), static_cast<float>(scaled ? 1.0 - f0 : 1.0),
          specular.diffuse == DiffuseConvention::kScaled, to_metallic ? specular_width : metallic_uncertainty,
          to_metallic ? metallic_uncertainty : specular_width};
}

}  // namespace remap
