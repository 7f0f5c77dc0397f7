// The two workflows in which a material is described, and the meaning of their parameters. The specular
// workflow has a diffuse and a specular color, the metallic workflow a base color and metallic (Sztrajman et
// al. 2019, section 8). Both are layers over the same BRDF.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "remap/converter.hpp"
#include "remap/model.hpp"

namespace remap {

// Fully connected networks.

// normalised = (t - offset) * scale, with t = value, or t = value / (value + pole), which spreads values near
// 0, where curves over alpha bend most.
struct Scaling {
  double offset = 0.0;
  double scale = 1.0;  // not 0
  double pole = 0.0;   // >= 0; 0: t = value. Outputs have none
  bool operator==(const Scaling&) const = default;
};

enum class Activation { kRelu, kTanh, kSilu };
inline constexpr NamedValues<Activation, 3> kActivations = {
    {{Activation::kRelu, "relu"}, {Activation::kTanh, "tanh"}, {Activation::kSilu, "silu"}}};
inline std::string_view activation_name(Activation activation) { return name_of(kActivations, activation); }

// One layer: outputs = weights inputs + biases.
struct Layer {
  std::size_t input_count = 0;
  std::vector<double> weights;  // one row of input_count per output
  std::vector<double> biases;   // one per output
  std::size_t output_count() const noexcept { return biases.size(); }
  bool operator==(const Layer&) const = default;
};

// A fully connected network of normalised inputs and outputs, with `activation` after every layer but the
// last.
struct Network {
  Activation activation = Activation::kTanh;
  std::vector<Scaling> inputs;
  std::vector<Scaling> outputs;
  std::vector<Layer> layers;  // at least 1
  bool operator==(const Network&) const = default;
};

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

// Workflows with a name, the conventions of their parameters, and their BRDF.

enum class WorkflowKind { kSpecular, kMetallic };
inline constexpr NamedValues<WorkflowKind, 2> kWorkflowKinds = {
    {{WorkflowKind::kSpecular, "specular"}, {WorkflowKind::kMetallic, "metallic"}}};

// One side of a conversion of whole materials.
using WorkflowEnd = std::variant<SpecularWorkflow, MetallicWorkflow>;
inline WorkflowKind kind_of(const WorkflowEnd& end) noexcept {
  return std::holds_alternative<SpecularWorkflow>(end) ? WorkflowKind::kSpecular : WorkflowKind::kMetallic;
}
inline const std::string& model_of(const WorkflowEnd& end) noexcept {
  return std::visit([](const auto& workflow) -> const std::string& { return workflow.model; }, end);
}
inline RoughnessConvention width_of(const WorkflowEnd& end) noexcept {
  return std::visit([](const auto& workflow) { return workflow.width; }, end);
}
inline DiffuseConvention diffuse_of(const WorkflowEnd& end) noexcept {
  return std::visit([](const auto& workflow) { return workflow.diffuse; }, end);
}
inline std::string_view kind_name(const WorkflowEnd& end) noexcept {
  return name_of(kWorkflowKinds, kind_of(end));
}

// A workflow with a name.
struct WorkflowModel {
  WorkflowEnd end;
  std::string brdf;                // model of its width and specular in the graph of converters
  bool conventions_known = false;  // from its specification or source code; otherwise assumed
  std::string reason;              // the source of the conventions
};

// `gltf`, `gltf-specgloss`, `cycles-5/principled`, `threejs/standard`, `usd-preview-surface`, `metallic`,
// `specular`.
const std::vector<WorkflowModel>& workflow_models();
// Null for an unknown name.
const WorkflowModel* find_workflow_model(std::string_view name);

// A name that people use for a workflow model, or for a BRDF model of the graph.
struct ModelAlias {
  std::string_view name;     // lower case, words joined by '-'
  std::string_view model;    // of workflow_models(), or such as `legacy/phong`
  std::string_view meaning;  // of materials of that name, after its documentation or source code
};
std::span<const ModelAlias> model_aliases();
// Null for none. Case does not count, and '_', '.' and ' ' stand for '-'.
const ModelAlias* find_alias(std::string_view name);

// A BRDF model of the graph, such as `mitsuba/ward`, as a specular or a metallic workflow with the common
// conventions.
WorkflowModel workflow_over(const std::string& brdf, WorkflowKind kind, RoughnessConvention width);

// Whether maps of the model `name` hold materials of `end` over `brdf`. For example `specular` and
// mitsuba/ggx are both layers over mitsuba/ggx with plain diffuse. The encoding of the roughness is not
// compared, nor a convention that the model leaves open.
bool holds_materials_of(const std::string& name, const WorkflowEnd& end, const std::string& brdf);

// Whether both describe the same material by the same numbers over one BRDF. Their names and the encodings of
// the roughness are not compared.
bool is_same_material(const WorkflowEnd& a, const WorkflowEnd& b);

// Converters of whole materials between workflows.

// The parameters of a material of a workflow, in the order of Parameter.
std::vector<Parameter> parameters_of(const WorkflowEnd& end);

// The stages of a conversion from one workflow to another.
struct WorkflowStages {
  WorkflowEnd source, target;
  // Between the BRDFs of both ends; null if they are the same.
  const Converter* brdf = nullptr;
  RoughnessConvention width = RoughnessConvention::kRoughness;  // of both ends if `brdf` is null
  double prior = kCleanPrior;  // of the projection, if the target is metallic
};

// The stages: equation (2) if the source is metallic, then those of `brdf` for width and specular, then the
// projection if the target is metallic; none for one material at both ends. The diffuse lobe keeps its
// reflectance where `brdf` changes specular, so scaled diffuse is scaled to the new specular. Throws kInput
// as require_valid() does.
std::unique_ptr<Converter> make_workflow_converter(const WorkflowStages& stages,
                                                   InstructionSet set = best_instruction_set());

}  // namespace remap
