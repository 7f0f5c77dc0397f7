// The two workflows in which a material is described, and the meaning of their parameters. The specular
// workflow has a diffuse and a specular color, the metallic workflow a base color and metallic (Sztrajman et
// al. 2019, section 8). Both are layers over the same BRDF.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "remap/convention.hpp"
#include "remap/named_values.hpp"
#include "remap/network.hpp"

namespace remap {

// The meaning of a diffuse color.
enum class DiffuseConvention {
  kPlain,   // the reflectance of the diffuse lobe
  kScaled,  // times 1 - max(specular), the reflectance of the diffuse lobe (glTF 2.0)
};
inline constexpr NamedValues<DiffuseConvention, 2> kDiffuseConventions = {
    {{DiffuseConvention::kPlain, "plain"}, {DiffuseConvention::kScaled, "scaled"}}};
inline std::string_view diffuse_convention_name(DiffuseConvention convention) {
  return name_of(kDiffuseConventions, convention);
}

inline constexpr double kCommonDielectricF0 = 0.04;  // glTF, Unreal, Disney
inline constexpr double kPaperDielectricF0 = 0.03;   // Sztrajman et al. 2019

// Diffuse RGB, specular RGB (F0, linear, 0 to 1) and a width.
struct SpecularWorkflow {
  std::string model = "specular";
  DiffuseConvention diffuse = DiffuseConvention::kPlain;
  RoughnessConvention width = RoughnessConvention::kRoughness;  // roughness, glossiness or alpha
  bool operator==(const SpecularWorkflow&) const = default;
};

// Base color RGB (linear, 0 to 1), metallic (0 to 1) and a width. With n = 1 - metallic, diffuse reflectance
// is base color n, times 1 - dielectric_f0 where diffuse is scaled; F0 is dielectric_f0 n + base color
// metallic.
struct MetallicWorkflow {
  std::string model = "metallic";
  double dielectric_f0 = kCommonDielectricF0;  // [0, 0.9]
  DiffuseConvention diffuse = DiffuseConvention::kPlain;
  RoughnessConvention width = RoughnessConvention::kRoughness;
  bool operator==(const MetallicWorkflow&) const = default;
};

// From metallic to specular: equation (2) of the paper, exact.
struct Equation2 {
  bool operator==(const Equation2&) const = default;
};

// From specular to metallic, which cannot represent all specular materials.
//
// The projection: the base color and metallic with the least difference in pictures, in closed form. `prior`
// times the mean weight times metallic (1 - metallic) is added to the error, so that of two similar solutions
// the one nearer to metallic 0 or 1 is chosen.
struct Projection {
  double prior = 0.0;  // >= 0
  bool operator==(const Projection&) const = default;
};
inline constexpr double kCleanPrior = 1e-6;  // for maps without noise, 8 bits or more
inline constexpr double kNoisyPrior = 1e-5;  // for scans and JPEG
inline constexpr double kLargestPrior = 1.0;

// Equation (3) of the paper: the inverse of equation (2) for each channel separately. Metallic is the mean
// over the channels.
enum class MetallicMean {
  kPlain,
  kAlbedo,  // weighted by albedo
};
inline constexpr NamedValues<MetallicMean, 2> kMetallicMeans = {
    {{MetallicMean::kPlain, "plain"}, {MetallicMean::kAlbedo, "albedo"}}};
struct Equation3 {
  MetallicMean mean = MetallicMean::kAlbedo;
  bool operator==(const Equation3&) const = default;
};

// The solver of KHR_materials_pbrSpecularGlossiness (Khronos Group 2017), for scaled diffuse.
struct KhronosSolver {
  bool operator==(const KhronosSolver&) const = default;
};

// A network that was trained on the inverse of equation (2) (section 8 of the paper): from diffuse RGB and
// specular RGB, in the conventions of the specular workflow, to base color RGB and metallic, without
// roughness.
struct LearnedNetwork {
  Network network;  // 6 inputs, 4 outputs
  bool operator==(const LearnedNetwork&) const = default;
};

using WorkflowFormula = std::variant<Equation2, Projection, Equation3, KhronosSolver, LearnedNetwork>;

// Whether it was trained on a table; the others are closed forms.
inline bool is_learned(const WorkflowFormula& formula) noexcept {
  return std::holds_alternative<LearnedNetwork>(formula);
}

// `equation-2`, `projection`, `equation-3`, `khronos`, `network`.
std::string_view formula_name(const WorkflowFormula& formula);
// A description for cards.
std::string formula_text(const WorkflowFormula& formula);

// A conversion of whole materials. The formula determines the direction.
struct WorkflowConversion {
  SpecularWorkflow specular;
  MetallicWorkflow metallic;
  WorkflowFormula formula;
  bool is_to_metallic() const noexcept { return !std::holds_alternative<Equation2>(formula); }
  const std::string& source_model() const noexcept {
    return is_to_metallic() ? specular.model : metallic.model;
  }
  const std::string& target_model() const noexcept {
    return is_to_metallic() ? metallic.model : specular.model;
  }
  bool operator==(const WorkflowConversion&) const = default;
};

// Throws kInput, beginning with `place`, for a width other than roughness, glossiness or alpha, for F0 or a
// prior out of range, for Khronos' solver unless diffuse is scaled on both sides and F0 is above 0, and for a
// network without 6 inputs and 4 outputs.
void require_valid(const WorkflowConversion& conversion, const std::string& place);

// A parameter of a material, with one row of texels per channel.
struct MaterialParameter {
  std::string name;
  int channel_count = 1;  // 1 or 3
  std::string meaning;
};

// In the order of the rows: diffuse, specular, width; or base_color, metallic, width.
std::vector<MaterialParameter> source_parameters(const WorkflowConversion& conversion);
std::vector<MaterialParameter> target_parameters(const WorkflowConversion& conversion);

}  // namespace remap
