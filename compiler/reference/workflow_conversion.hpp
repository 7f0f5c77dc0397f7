// This file converts whole materials between the two workflows, texel by texel. It has every formula that
// remap measures or ships. Closed forms use floats. If products and sums are not fused, they give the same
// bits as the generated header. Networks run in double precision, so that tests can compare headers with
// them.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "reference/network.hpp"
#include "remap/workflow.hpp"
#include "stages/dielectric_f0.hpp"
#include "stages/workflow_conventions.hpp"

namespace remap {

// A ClosedFormula is a formula without fitted numbers. Metallic workflows cannot express all specular
// materials, so the formulas to metallic differ.
enum class ClosedFormula {
  kEquation2,  // from metallic to specular by equation (2) of the paper; it is exact
  kEquation3,  // the inverse of equation (2) for each channel separately; metallic is the mean over channels
  kEquation3ByAlbedo,  // like kEquation3, but the mean is weighted by albedo
  kKhronos,            // solves KHR_materials_pbrSpecularGlossiness (Khronos Group 2017), for scaled diffuse
};
inline constexpr NamedValues<ClosedFormula, 2> kMetallicMeans = {
    {{ClosedFormula::kEquation3, "plain"}, {ClosedFormula::kEquation3ByAlbedo, "albedo"}}};

// The following formulas convert from specular to metallic, which cannot express all specular materials.
//
// A Projection finds the base color and metallic whose pictures differ least, in closed form.
struct Projection {
  double prior = 0.0;  // at least 0 (kCleanPrior)
  bool operator==(const Projection&) const = default;
};

// A network was trained on the inverse of equation (2) (section 8 of the paper). It goes from diffuse RGB and
// specular RGB, in the conventions of the specular workflow, to base color RGB and metallic, without
// roughness.
using WorkflowFormula = std::variant<ClosedFormula, Projection, Network>;

inline bool is_formula(const WorkflowFormula& formula, ClosedFormula closed) noexcept {
  const ClosedFormula* const own = std::get_if<ClosedFormula>(&formula);
  return own != nullptr && *own == closed;
}
// Returns true if the formula was trained on a table. All others are closed forms.
inline bool is_learned(const WorkflowFormula& formula) noexcept {
  return std::holds_alternative<Network>(formula);
}

// Returns `equation-2`, `projection`, `equation-3`, `khronos` or `network`.
std::string_view formula_name(const WorkflowFormula& formula);
// Returns a description of the formula, for reports and headers.
std::string formula_text(const WorkflowFormula& formula);

// A WorkflowConversion converts whole materials. Its formula decides the direction.
struct WorkflowConversion {
  SpecularWorkflow specular;
  MetallicWorkflow metallic;
  WorkflowFormula formula;
  bool is_to_metallic() const noexcept { return !is_formula(formula, ClosedFormula::kEquation2); }
  const std::string& source_model() const noexcept {
    return is_to_metallic() ? specular.model : metallic.model;
  }
  const std::string& target_model() const noexcept {
    return is_to_metallic() ? metallic.model : specular.model;
  }
  bool operator==(const WorkflowConversion&) const = default;
};

// Throws kInput, beginning with `context`, if the conversion breaks one of these rules. The width is
// roughness, glossiness or alpha. F0 and the prior are in their ranges. Khronos' solver needs scaled diffuse
// on both sides, and F0 above 0. A network has 6 inputs and 4 outputs.
void require_valid(const WorkflowConversion& conversion, const std::string& context);

// A MaterialParameter is a parameter of a material, with one row of texels per channel.
struct MaterialParameter {
  std::string name;
  int channel_count = 1;  // 1 or 3
  std::string meaning;
};

// Return the parameters in the order of the rows. These are diffuse, specular, width, or base_color,
// metallic, width.
std::vector<MaterialParameter> source_parameters(const WorkflowConversion& conversion);
std::vector<MaterialParameter> target_parameters(const WorkflowConversion& conversion);

// Returns the constants of a conversion for its formulas.
workflow_code::Conventions conventions_of(const WorkflowConversion& conversion);

// A MetallicMaterial is one texel, like SpecularMaterial.
struct MetallicMaterial {
  std::array<float, 3> base_color{};
  float metallic = 0.0f;
  float width = 0.0f;
};

// Converts `count` texels. `in` and `out` have one row for each channel, in the order of source_parameters()
// and target_parameters(). An output row may be an input row. Other rows must not overlap. Values outside of
// [0, 1] are clamped. NaN makes the outputs that depend on it NaN. Returns the number of texels with such
// values. Throws kUsage for a wrong number of rows, and the errors of require_valid().
std::size_t convert_workflow(const WorkflowConversion& conversion, std::size_t count,
                             std::span<const float* const> in, std::span<float* const> out);

// Converts one texel. Throws kUsage for a conversion in the other direction.
MetallicMaterial to_metallic(const WorkflowConversion& conversion, const SpecularMaterial& material);
SpecularMaterial to_specular(const WorkflowConversion& conversion, const MetallicMaterial& material);

struct MetallicDiagnosis {
  // This is the square root of the weighted squared error that remains, or 0 if the material is matched
  // exactly. Under natural light, pictures differ by about 0.42 times this value (root mean square of display
  // values).
  float residual = 0.0f;
  // This is how much metallic can vary, as a fraction of [0, 1], while the squared error (with the best base
  // color) stays within (1/255)^2 of the smallest. Above 0.2, metallic is not reliable, but all
  // values in this range give almost the same picture.
  float metallic_uncertainty = 0.0f;
  // True if a parameter was outside of [0, 1], or if a base color was outside by more than half a step of 8
  // bits.
  bool is_clamped = false;
};

// Diagnoses `result`, which may come from any method, as a conversion of `material`. Weights and errors are
// those of the projection without its prior. If the texel has NaN, returns {NaN, NaN, true}. Throws the
// errors of require_valid().
MetallicDiagnosis diagnose(const WorkflowConversion& conversion, const SpecularMaterial& material,
                           const MetallicMaterial& result);

}  // namespace remap
