// Two ways to say what a material is made of, and what their parameters mean. The specular workflow has a
// diffuse and a specular color; the metallic one a base color and how metallic it is (Sztrajman et al.
// 2019, section 8). Both are layers over the same BRDF.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "remap/convention.hpp"
#include "remap/mapping.hpp"

namespace remap {

// What a diffuse color means.
enum class DiffuseConvention {
  kPlain,   // reflectance of the diffuse lobe
  kScaled,  // of the light that the specular lobe leaves: the lobe has it times 1 - max(specular) (glTF 2.0)
};
std::string_view diffuse_convention_name(DiffuseConvention convention);
std::optional<DiffuseConvention> diffuse_convention_from_name(std::string_view name);
std::vector<std::string> diffuse_convention_names();

// F0 of a dielectric in common use: glTF, Unreal, Disney; and the paper's.
inline constexpr double kCommonDielectricF0 = 0.04;
inline constexpr double kPaperDielectricF0 = 0.03;

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

// From specular to metallic, which cannot say all that specular can.
//
// The projection: the base color and metallic whose picture differs least, in closed form. `prior` times the
// mean weight times metallic (1 - metallic) is added to the error, so that of two answers that look alike the
// purer one is taken.
struct Projection {
  double prior = 0.0;  // >= 0
  bool operator==(const Projection&) const = default;
};
inline constexpr double kCleanPrior = 1e-6;  // of maps without noise, 8 bits or more
inline constexpr double kNoisyPrior = 1e-5;  // of scans and JPEG
inline constexpr double kLargestPrior = 1.0;

// Equation (3) of the paper: the inverse of equation (2) for each channel by itself. Metallic is the mean
// over them.
enum class MetallicMean {
  kPlain,
  kAlbedo,  // weighted by albedo
};
struct Equation3 {
  MetallicMean mean = MetallicMean::kAlbedo;
  bool operator==(const Equation3&) const = default;
};
std::string_view metallic_mean_name(MetallicMean mean);
std::optional<MetallicMean> metallic_mean_from_name(std::string_view name);

// The solver of KHR_materials_pbrSpecularGlossiness (Khronos Group 2017), for diffuse that is scaled.
struct KhronosSolver {
  bool operator==(const KhronosSolver&) const = default;
};

// A network that has learned the way back (section 8 of the paper): of diffuse RGB and specular RGB, as the
// parameters of the specular workflow are given, to base color RGB and metallic. Roughness takes no part.
struct LearnedNetwork {
  Network network;  // 6 inputs, 4 outputs
  bool operator==(const LearnedNetwork&) const = default;
};

using WorkflowFormula = std::variant<Equation2, Projection, Equation3, KhronosSolver, LearnedNetwork>;

// Whether it was learned from a table; the others are closed forms.
inline bool is_learned(const WorkflowFormula& formula) noexcept {
  return std::holds_alternative<LearnedNetwork>(formula);
}

// `equation-2`, `projection`, `equation-3`, `khronos`, `network`.
std::string_view formula_name(const WorkflowFormula& formula);
// `by equation (2)`, and so on, for cards.
std::string formula_text(const WorkflowFormula& formula);

// A conversion of whole materials: both ends, and the formula, which says in which direction.
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

// Throws kInput, opened by `place`, for a width that is neither roughness, glossiness nor alpha, an F0 out of
// range, a negative or huge prior, Khronos' solver where diffuse is not scaled on both sides or F0 is 0, and
// a network of other than 6 inputs and 4 outputs.
void require_valid(const WorkflowConversion& conversion, const std::string& place);

// A parameter of a material as converters take it: one row of texels a channel.
struct MaterialParameter {
  std::string name;
  int channel_count = 1;  // 1 or 3
  std::string meaning;
};

// In the order of the rows: diffuse, specular, width; or base_color, metallic, width.
std::vector<MaterialParameter> source_parameters(const WorkflowConversion& conversion);
std::vector<MaterialParameter> target_parameters(const WorkflowConversion& conversion);

}  // namespace remap
