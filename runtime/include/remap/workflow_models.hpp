// The workflows that people name, with what each takes its parameters for, and the BRDF that it stands on.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "remap/workflow.hpp"

namespace remap {

enum class WorkflowKind { kSpecular, kMetallic };
// `specular`, `metallic`.
std::string_view workflow_kind_name(WorkflowKind kind);
std::optional<WorkflowKind> workflow_kind_from_name(std::string_view name);
std::vector<std::string> workflow_kind_names();

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

// A workflow under the name that it goes by.
struct WorkflowModel {
  WorkflowEnd end;
  std::string brdf;                // of the graph of converters, which its width and specular are of
  bool conventions_known = false;  // by its specification or its source; otherwise they are only common
  std::string reason;              // where the conventions come from, for people
};

// `gltf`, `gltf-specgloss`, `cycles-5/principled`, `threejs/standard`, `usd-preview-surface`, `metallic`,
// `specular`.
const std::vector<WorkflowModel>& workflow_models();
// Null where there is none of that name.
const WorkflowModel* find_workflow_model(std::string_view name);

// A layer over a BRDF model of the graph: `mitsuba/ward` as a specular or a metallic workflow. Its
// conventions are the common ones.
WorkflowModel workflow_over(const std::string& brdf, WorkflowKind kind, RoughnessConvention width);

// Whether values that were written as those of `name` are materials of `end` over `brdf`: `specular` is a
// layer over mitsuba/ggx with plain diffuse, and so is mitsuba/ggx by itself. What the maps of widths hold is
// left to their names and to options.
bool holds_materials_of(const std::string& name, const WorkflowEnd& end, const std::string& brdf);

}  // namespace remap
