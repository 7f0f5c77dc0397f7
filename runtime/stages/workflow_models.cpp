#include "remap/workflow.hpp"

namespace remap {
namespace {

constexpr auto kPlain = DiffuseConvention::kPlain, kScaled = DiffuseConvention::kScaled;
constexpr auto kRoughness = RoughnessConvention::kRoughness, kGlossiness = RoughnessConvention::kGlossiness;

// All of these have GGX lobes of alpha = roughness^2. The BRDF is the renderer's own lobe if a converter was
// measured with it, else Mitsuba's GGX.
std::vector<WorkflowModel> make_models() {
  return {
      {MetallicWorkflow{"gltf", kCommonDielectricF0, kScaled, kRoughness}, "mitsuba/ggx", true,
       "glTF 2.0, appendix B: index 1.5, the diffuse lobe has what the Fresnel lobe leaves"},
      {SpecularWorkflow{"gltf-specgloss", kScaled, kGlossiness}, "mitsuba/ggx", true,
       "KHR_materials_pbrSpecularGlossiness: diffuse counts 1 - max(specular), alpha = (1 - glossiness)^2"},
      {MetallicWorkflow{"cycles-5/principled", kCommonDielectricF0, kScaled, kRoughness},
       "cycles-5/principled-metal", true,
       "Principled of Blender 5 at its default index 1.5 and specular level: diffuse below the specular "
       "layer"},
      {MetallicWorkflow{"threejs/standard", kCommonDielectricF0, kPlain, kRoughness},
       "threejs-r187/standard-metal", true,
       "lights_standard_fragment of three.js: base color (1 - metalness), F0 mixed from 0.04"},
      {MetallicWorkflow{"usd-preview-surface", kCommonDielectricF0, kPlain, kRoughness}, "mitsuba/ggx", false,
       "UsdPreviewSurface with metallic at its default index 1.5; what renderers make of its diffuse "
       "differs"},
      {MetallicWorkflow{"metallic", kCommonDielectricF0, kPlain, kRoughness}, "mitsuba/ggx", false,
       "what most metallic materials mean"},
      {SpecularWorkflow{"specular", kPlain, kRoughness}, "mitsuba/ggx", false,
       "what most specular materials mean"},
  };
}

}  // namespace

const std::vector<WorkflowModel>& workflow_models() {
  static const std::vector<WorkflowModel> models = make_models();
  return models;
}

const WorkflowModel* find_workflow_model(std::string_view name) {
  for (const WorkflowModel& model : workflow_models())
    if (model_of(model.end) == name) return &model;
  return nullptr;
}

WorkflowModel workflow_over(const std::string& brdf, WorkflowKind kind, RoughnessConvention width) {
  WorkflowModel model;
  model.brdf = brdf;
  model.reason = "a " + std::string(name_of(kWorkflowKinds, kind)) + " layer over " + brdf;
  if (kind == WorkflowKind::kSpecular)
    model.end = SpecularWorkflow{brdf, kPlain, width};
  else
    model.end = MetallicWorkflow{brdf, kCommonDielectricF0, kPlain, width};
  return model;
}

bool holds_materials_of(const std::string& name, const WorkflowEnd& end, const std::string& brdf) {
  const WorkflowModel* known = find_workflow_model(name);
  const WorkflowModel written =
      known != nullptr ? *known : workflow_over(name, WorkflowKind::kSpecular, kRoughness);
  const auto dielectric_f0 = [](const WorkflowEnd& of) {
    const auto* metallic = std::get_if<MetallicWorkflow>(&of);
    return metallic != nullptr ? metallic->dielectric_f0 : 0.0;
  };
  return written.brdf == brdf && kind_of(written.end) == kind_of(end) &&
         diffuse_of(written.end) == diffuse_of(end) && dielectric_f0(written.end) == dielectric_f0(end);
}

}  // namespace remap
