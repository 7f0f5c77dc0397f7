#include "stages/workflow_conventions.hpp"

#include <algorithm>
#include <array>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "remap/workflow.hpp"

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

namespace {

constexpr auto kPlain = DiffuseConvention::kPlain, kScaled = DiffuseConvention::kScaled;
constexpr auto kRoughness = RoughnessEncoding::kRoughness, kGlossiness = RoughnessEncoding::kGlossiness;

// All of these have GGX lobes of alpha = roughness^2. If a converter was measured with the renderer's own
// lobe, this lobe is the BRDF. Otherwise, it is Mitsuba's GGX.
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
      {SpecularWorkflow{"usd-preview-surface-specular", kPlain, kRoughness}, "mitsuba/ggx", false,
       "UsdPreviewSurface with useSpecularWorkflow 1: specularColor is F0, which rises to 1 at the rim"},
      {MetallicWorkflow{"metallic", kCommonDielectricF0, kPlain, kRoughness}, "mitsuba/ggx", false,
       "what most metallic materials mean"},
      {SpecularWorkflow{"specular", kPlain, kRoughness}, "mitsuba/ggx", false,
       "what most specular materials mean"},
  };
}

// These are the default materials of engines and tools, as their documentation describes them.
constexpr std::string_view kLayered = "index 1.5, the diffuse lobe has what the specular lobe leaves";
constexpr std::string_view kPlainMetal = "base color (1 - metallic), F0 0.04";
constexpr std::string_view kUnityLit = "Lit and Standard: base color 0.96 (1 - metallic), F0 0.04";
constexpr std::string_view kUnitySpecular = "specular setup: diffuse counts 1 - max(specular), smoothness";
constexpr std::string_view kPrincipled = "the Principled BSDF of Blender 5";
constexpr std::string_view kUnrealLit =
    "default lit: base color (1 - metallic), F0 0.04 at a Specular of 0.5";
constexpr std::string_view kBlinn =
    "(N.H)^n, neither normalised nor times the cosine of the light; roughness is the exponent n";
constexpr std::array<ModelAlias, 52> kAliases = {{
    {"ambientcg", "metallic", kPlainMetal},
    {"arnold", "gltf", kLayered},
    {"babylon", "gltf", kLayered},
    {"blender", "cycles-5/principled", kPrincipled},
    {"blinn-phong", "legacy/blinn-phong", kBlinn},
    {"core", "gltf", kLayered},
    {"cycles/principled", "cycles-5/principled", kPrincipled},
    {"filament", "metallic", kPlainMetal},
    {"glb", "gltf", kLayered},
    {"gltf-2-0", "gltf", kLayered},
    {"gltf2", "gltf", kLayered},
    {"godot", "metallic", "StandardMaterial3D: base color (1 - metallic), F0 0.04 at a specular of 0.5"},
    {"khr-materials-pbrspecularglossiness", "gltf-specgloss", "the extension of glTF 2.0"},
    {"marmoset", "metallic", kPlainMetal},
    {"megascans", "metallic", kPlainMetal},
    {"metal-rough", "metallic", kPlainMetal},
    {"metallic-roughness", "metallic", kPlainMetal},
    {"metalness", "metallic", kPlainMetal},
    {"metalrough", "metallic", kPlainMetal},
    {"mtl", "legacy/blinn-phong", kBlinn},
    {"mujoco", "mujoco/material-linear",
     "what its windows show on a display of gamma 2.2; roughness is the exponent, 128 times shininess, and "
     "specular is linear"},
    {"open-pbr-surface", "gltf", kLayered},
    {"opengl", "legacy/blinn-phong", kBlinn},
    {"openpbr", "gltf", kLayered},
    {"pbr", "metallic", kPlainMetal},
    {"phong", "legacy/phong", "(R.V)^n, neither normalised nor times the cosine of the light"},
    {"playcanvas", "metallic", kPlainMetal},
    {"polyhaven", "metallic", kPlainMetal},
    {"preview-surface", "usd-preview-surface", "UsdPreviewSurface with metallic"},
    {"principled", "cycles-5/principled", kPrincipled},
    {"principled-bsdf", "cycles-5/principled", kPrincipled},
    {"quixel", "metallic", kPlainMetal},
    {"spec-gloss", "gltf-specgloss", "diffuse counts 1 - max(specular), alpha = (1 - glossiness)^2"},
    {"specgloss", "gltf-specgloss", "diffuse counts 1 - max(specular), alpha = (1 - glossiness)^2"},
    {"specular-glossiness", "gltf-specgloss", "diffuse counts 1 - max(specular), alpha = (1 - glossiness)^2"},
    {"standard-surface", "gltf", kLayered},
    {"substance", "metallic", kPlainMetal},
    {"three", "threejs/standard", "MeshStandardMaterial"},
    {"three-js", "threejs/standard", "MeshStandardMaterial"},
    {"threejs", "threejs/standard", "MeshStandardMaterial"},
    {"ue4", "metallic", kUnrealLit},
    {"ue5", "metallic", kUnrealLit},
    {"unity", "gltf", kUnityLit},
    {"unity-hdrp", "gltf", kUnityLit},
    {"unity-specular", "gltf-specgloss", kUnitySpecular},
    {"unity-urp", "gltf", kUnityLit},
    {"unreal", "metallic", kUnrealLit},
    {"unreal-engine", "metallic", kUnrealLit},
    {"usd", "usd-preview-surface", "UsdPreviewSurface with metallic"},
    {"usd-specular", "usd-preview-surface-specular", "UsdPreviewSurface with useSpecularWorkflow 1"},
    {"usdpreviewsurface", "usd-preview-surface", "UsdPreviewSurface with metallic"},
    {"usdz", "usd-preview-surface", "UsdPreviewSurface with metallic"},
}};

}  // namespace

std::span<const ModelAlias> model_aliases() { return kAliases; }

const ModelAlias* find_alias(std::string_view name) {
  const auto is_typed = [name](const ModelAlias& alias) {
    return std::ranges::equal(name, alias.name, [](char typed, char known) {
      if (typed >= 'A' && typed <= 'Z') typed = static_cast<char>(typed - 'A' + 'a');
      return (typed == '_' || typed == '.' || typed == ' ' ? '-' : typed) == known;
    });
  };
  const auto* found = std::ranges::find_if(kAliases, is_typed);
  return found == kAliases.end() ? nullptr : found;
}

const std::vector<WorkflowModel>& workflow_models() {
  static const std::vector<WorkflowModel> models = make_models();
  return models;
}

const WorkflowModel* find_workflow_model(std::string_view name) {
  for (const WorkflowModel& model : workflow_models())
    if (model_of(model.end) == name) return &model;
  return nullptr;
}

WorkflowModel workflow_over(const std::string& brdf, WorkflowKind kind, RoughnessEncoding width) {
  WorkflowModel model;
  model.brdf = brdf;
  model.reason = "a " + std::string(name_of(kWorkflowKinds, kind)) + " layer over " + brdf;
  // These models add the lobe to diffuse, and do not reduce diffuse (OpenGL 1.0, section 2.13).
  model.conventions_known = brdf.starts_with("legacy/") || brdf.starts_with("mujoco/");
  if (kind == WorkflowKind::kSpecular)
    model.end = SpecularWorkflow{brdf, kPlain, width};
  else
    model.end = MetallicWorkflow{brdf, kCommonDielectricF0, kPlain, width};
  return model;
}

bool is_same_material(const WorkflowEnd& a, const WorkflowEnd& b) {
  const auto dielectric_f0 = [](const WorkflowEnd& of) {
    const auto* metallic = std::get_if<MetallicWorkflow>(&of);
    return metallic != nullptr ? metallic->dielectric_f0 : 0.0;
  };
  return kind_of(a) == kind_of(b) && diffuse_of(a) == diffuse_of(b) && dielectric_f0(a) == dielectric_f0(b);
}

bool holds_materials_of(const std::string& name, const WorkflowEnd& end, const std::string& brdf) {
  const WorkflowModel* known = find_workflow_model(name);
  const WorkflowModel written =
      known != nullptr ? *known : workflow_over(name, WorkflowKind::kSpecular, kRoughness);
  WorkflowEnd held = written.end;
  // If the model leaves the convention open, use the convention of the other end.
  if (known != nullptr && !known->conventions_known)
    std::visit([&](auto& workflow) { workflow.diffuse = diffuse_of(end); }, held);
  return written.brdf == brdf && is_same_material(held, end);
}

}  // namespace remap
