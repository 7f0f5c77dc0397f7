// Workflows with a name, the conventions of their parameters, and their BRDF.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "remap/workflow.hpp"

namespace remap {

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

// A BRDF model of the graph, such as `mitsuba/ward`, as a specular or a metallic workflow with the common
// conventions.
WorkflowModel workflow_over(const std::string& brdf, WorkflowKind kind, RoughnessConvention width);

// Whether maps of the model `name` hold materials of `end` over `brdf`. For example `specular` and
// mitsuba/ggx are both layers over mitsuba/ggx with plain diffuse. The encoding of the roughness is not
// compared.
bool holds_materials_of(const std::string& name, const WorkflowEnd& end, const std::string& brdf);

}  // namespace remap
