// This file describes the two workflows for materials, and the meaning of their parameters. The specular
// workflow has a diffuse and a specular color. The metallic workflow has a base color and metallic (Sztrajman
// et al. 2019, section 8). Both are layers over the same BRDF.
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

// A DiffuseConvention is the meaning of a diffuse color.
enum class DiffuseConvention {
  kPlain,   // it is the reflectance of the diffuse lobe
  kScaled,  // times 1 - max(specular), it is the reflectance of the diffuse lobe (glTF 2.0)
};
inline constexpr NamedValues<DiffuseConvention, 2> kDiffuseConventions = {
    {{DiffuseConvention::kPlain, "plain"}, {DiffuseConvention::kScaled, "scaled"}}};
inline std::string_view diffuse_convention_name(DiffuseConvention convention) {
  return name_of(kDiffuseConventions, convention);
}

inline constexpr double kCommonDielectricF0 = 0.04;  // glTF, Unreal, Disney
inline constexpr double kPaperDielectricF0 = 0.03;   // Sztrajman et al. 2019

// A SpecularWorkflow has diffuse RGB, specular RGB (F0, linear, 0 to 1) and a width.
struct SpecularWorkflow {
  std::string model = "specular";
  DiffuseConvention diffuse = DiffuseConvention::kPlain;
  RoughnessEncoding width = RoughnessEncoding::kRoughness;  // roughness, glossiness or alpha
  bool operator==(const SpecularWorkflow&) const = default;
};

// A MetallicWorkflow has base color RGB (linear, 0 to 1), metallic (0 to 1) and a width. Let n = 1 -
// metallic. The diffuse reflectance is base color n, times 1 - dielectric_f0 where diffuse is scaled. F0 is
// dielectric_f0 n + base color metallic.
struct MetallicWorkflow {
  std::string model = "metallic";
  double dielectric_f0 = kCommonDielectricF0;  // [0, 0.9]
  DiffuseConvention diffuse = DiffuseConvention::kPlain;
  RoughnessEncoding width = RoughnessEncoding::kRoughness;
  bool operator==(const MetallicWorkflow&) const = default;
};

// The projection adds `prior` times the mean weight times metallic (1 - metallic) to its error. So if two
// solutions are similar, it chooses the solution that is closer to metallic 0 or 1.
inline constexpr double kCleanPrior = 1e-6;  // for maps without noise, 8 bits or more
inline constexpr double kNoisyPrior = 1e-5;  // for scans and JPEG
inline constexpr double kLargestPrior = 1.0;

// The following types give workflows a name, the conventions of their parameters, and their BRDF.

enum class WorkflowKind { kSpecular, kMetallic };
inline constexpr NamedValues<WorkflowKind, 2> kWorkflowKinds = {
    {{WorkflowKind::kSpecular, "specular"}, {WorkflowKind::kMetallic, "metallic"}}};

// A WorkflowEnd is one side of a conversion of whole materials.
using WorkflowEnd = std::variant<SpecularWorkflow, MetallicWorkflow>;
inline WorkflowKind kind_of(const WorkflowEnd& end) noexcept {
  return std::holds_alternative<SpecularWorkflow>(end) ? WorkflowKind::kSpecular : WorkflowKind::kMetallic;
}
inline const std::string& model_of(const WorkflowEnd& end) noexcept {
  return std::visit([](const auto& workflow) -> const std::string& { return workflow.model; }, end);
}
inline RoughnessEncoding width_of(const WorkflowEnd& end) noexcept {
  return std::visit([](const auto& workflow) { return workflow.width; }, end);
}
inline DiffuseConvention diffuse_of(const WorkflowEnd& end) noexcept {
  return std::visit([](const auto& workflow) { return workflow.diffuse; }, end);
}
inline std::string_view kind_name(const WorkflowEnd& end) noexcept {
  return name_of(kWorkflowKinds, kind_of(end));
}

// A WorkflowModel is a workflow with a name.
struct WorkflowModel {
  WorkflowEnd end;
  std::string brdf;                // model of its width and specular in the graph of converters
  bool conventions_known = false;  // false if they are assumed, because no specification states them
  std::string reason;              // the source of the conventions
};

// Returns `gltf`, `gltf-specgloss`, `cycles-5/principled`, `threejs/standard`, `usd-preview-surface`,
// `metallic` and `specular`.
const std::vector<WorkflowModel>& workflow_models();
// Returns null for an unknown name.
const WorkflowModel* find_workflow_model(std::string_view name);

// A ModelAlias is a name that people use for a workflow model, or for a BRDF model of the graph.
struct ModelAlias {
  std::string_view name;     // lower case, words joined by '-'
  std::string_view model;    // a workflow model, or a BRDF model such as `legacy/phong`
  std::string_view meaning;  // what the name means, by its documentation or source code
};
std::span<const ModelAlias> model_aliases();
// Returns null if there is no such alias. Case does not matter, and '_', '.' and ' ' are treated as '-'.
const ModelAlias* find_alias(std::string_view name);

// Returns a BRDF model of the graph, such as `mitsuba/ward`, as a specular or metallic workflow with the
// common conventions.
WorkflowModel workflow_over(const std::string& brdf, WorkflowKind kind, RoughnessEncoding width);

// Returns true if maps of the model `name` hold materials of `end` over `brdf`. For example `specular` and
// mitsuba/ggx are both layers over mitsuba/ggx with plain diffuse. It does not compare the encoding of the
// roughness, nor a convention that the model leaves open.
bool holds_materials_of(const std::string& name, const WorkflowEnd& end, const std::string& brdf);

// Returns true if both describe the same material by the same numbers over one BRDF. Does not compare names
// and encodings of roughness.
bool is_same_material(const WorkflowEnd& a, const WorkflowEnd& b);

// The following functions convert whole materials between workflows.

// Returns the parameters of a material of a workflow, in the order of Parameter.
std::vector<Parameter> parameters_of(const WorkflowEnd& end);

// A WorkflowStages describes the stages of a conversion from one workflow to another.
struct WorkflowStages {
  WorkflowEnd source, target;
  // This converts between the BRDFs of both ends. It is null if both ends have the same BRDF.
  const Converter* brdf = nullptr;
  RoughnessEncoding width = RoughnessEncoding::kRoughness;  // width of both ends if `brdf` is null
  double prior = kCleanPrior;                               // for the projection to metallic
};

// Makes the converter from up to three stages. If the source is metallic, equation (2) comes first. Then
// `brdf` changes width and specular. If the target is metallic, the projection comes last. If both ends are
// the same material, no stage is needed. The diffuse lobe keeps its reflectance if `brdf` changes specular,
// so scaled diffuse is scaled to the new specular. Throws kInput like require_valid().
std::unique_ptr<Converter> make_workflow_converter(const WorkflowStages& stages,
                                                   InstructionSet set = best_instruction_set());

}  // namespace remap
