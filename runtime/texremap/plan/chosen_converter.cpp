#include "texremap/plan/chosen_converter.hpp"

#include "core/number_text.hpp"

namespace remap {

std::string conventions_text(const WorkflowEnd& end) {
  std::string text = "diffuse " + std::string(diffuse_convention_name(diffuse_of(end)));
  if (const auto* metallic = std::get_if<MetallicWorkflow>(&end))
    text += ", dielectric F0 " + number_text(metallic->dielectric_f0);
  return text;
}

std::string converter_ids(const ChosenConverter& chosen) {
  std::string ids;
  for (const Converter* step : chosen.path.steps) ids += (ids.empty() ? "" : " ") + step->info().id;
  if (chosen.workflow.translation) return chosen.info().id;
  if (!chosen.workflow.is_material()) return ids;
  return ids + (ids.empty() ? "" : " ") + chosen.info().id + " (" +
         conventions_text(*chosen.workflow.source) + "; " + conventions_text(*chosen.workflow.target) +
         (chosen.workflow.finds_metallic() ? "; projection)" : ")");
}

}  // namespace remap
