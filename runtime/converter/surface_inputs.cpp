#include <algorithm>
#include <stdexcept>

#include "core/contains.hpp"
#include "generated/materials/materials.hpp"
#include "remap/surface.hpp"

namespace remap {
namespace {

namespace models = materials;

// A SameInput is an input that has another name in most models.
struct SameInput {
  std::string_view name, common;
  std::size_t channels = 0;  // if set, only inputs with so many channels
};
constexpr std::array<SameInput, 38> kSame = {{{"specular_roughness", "roughness"},
                                              {"base_metalness", "metallic"},
                                              {"metalness", "metallic"},
                                              {"diffuseColor", "base_color"},
                                              {"base", "base_weight"},
                                              {"base_diffuse_roughness", "diffuse_roughness"},
                                              {"specular", "specular_weight"},
                                              {"specular_tint", "specular_color"},
                                              {"specular_ior", "ior"},
                                              {"specular_IOR", "ior"},
                                              {"specular_roughness_anisotropy", "anisotropy"},
                                              {"specular_anisotropy", "anisotropy"},
                                              {"anisotropic", "anisotropy"},
                                              {"anisotropy_strength", "anisotropy"},
                                              {"specular_rotation", "anisotropy_rotation"},
                                              {"anisotropic_rotation", "anisotropy_rotation"},
                                              {"transmission", "transmission_weight"},
                                              {"subsurface", "subsurface_weight"},
                                              {"subsurface_radius", "subsurface_radius_scale", 3},
                                              {"subsurface_scatter_anisotropy", "subsurface_anisotropy"},
                                              {"sheen", "sheen_weight"},
                                              {"fuzz_weight", "sheen_weight"},
                                              {"fuzz_color", "sheen_color"},
                                              {"sheen_tint", "sheen_color"},
                                              {"fuzz_roughness", "sheen_roughness"},
                                              {"coat", "coat_weight"},
                                              {"clearcoat", "coat_weight"},
                                              {"clearcoat_roughness", "coat_roughness"},
                                              {"clearcoatRoughness", "coat_roughness"},
                                              {"coat_tint", "coat_color"},
                                              {"coat_roughness_anisotropy", "coat_anisotropy"},
                                              {"coat_IOR", "coat_ior"},
                                              {"thin_film_IOR", "thin_film_ior"},
                                              {"emissive", "emission_color"},
                                              {"emissiveColor", "emission_color"},
                                              {"geometry_opacity", "opacity"},
                                              {"opacity", "opacity_color", 3},
                                              {"alpha", "opacity"}}};

// Switches have no maps. Occlusion does not belong to the surface, and stays a separate map.
constexpr std::array<std::string_view, 9> kWithoutMap = {
    "useSpecularWorkflow", "specularColor", "opacityMode", "alpha_mode",          "occlusion",
    "thin_walled",         "alpha_cutoff",  "thickness",   "geometry_thin_walled"};

std::string_view common_name(std::string_view name, std::size_t channels) {
  const auto* found = std::ranges::find_if(kSame, [&](const SameInput& same) {
    return same.name == name && (same.channels == 0 || same.channels == channels);
  });
  return found == kSame.end() ? name : found->common;
}

// Workflows and surfaces both have these parameters.
constexpr std::array<NamedValue<Parameter>, 3> kShared = {{{Parameter::kRoughness, "roughness"},
                                                           {Parameter::kBaseColor, "base_color"},
                                                           {Parameter::kMetallic, "metallic"}}};

struct Tables {
  std::array<std::vector<SurfaceInput>, 6> surfaces;
  std::vector<SurfaceInput> named;  // inputs with parameters from kFirstInput on, by their common names
};

std::array<float, 3> channels_of(float value) { return {value, value, value}; }
std::array<float, 3> channels_of(const models::Color& color) { return {color.r, color.g, color.b}; }

Parameter parameter_of(std::string_view name, std::size_t channels, Tables& tables) {
  const std::string_view common = common_name(name, channels);
  if (const auto shared = value_named(kShared, common)) return *shared;
  const auto found = std::ranges::find(tables.named, common, &SurfaceInput::name);
  if (found != tables.named.end()) return *found->parameter;
  const std::size_t next = static_cast<std::size_t>(Parameter::kFirstInput) + tables.named.size();
  if (next >= kParameterCount) throw std::logic_error("kParameterCount is too small");
  return *tables.named.emplace_back(SurfaceInput{common, static_cast<Parameter>(next), channels}).parameter;
}

template <typename Model>
void add_surface(Surface surface, Tables& tables) {
  Model::for_each(Model{}, [&](std::string_view name, const auto& value) {
    const std::size_t channels = sizeof(value) / sizeof(float);
    SurfaceInput input{name, std::nullopt, channels, channels_of(value)};
    if (!contains(kWithoutMap, name)) input.parameter = parameter_of(name, channels, tables);
    tables.surfaces[static_cast<std::size_t>(surface)].push_back(input);
  });
}

// A LobeWeight is an input that hides the other inputs of its lobe if it is 0.
struct LobeWeight {
  std::string_view prefix, weight;
};
constexpr std::array<LobeWeight, 20> kWeights = {{{"coat", "coat_weight"},
                                                  {"coat", "coat"},
                                                  {"clearcoat", "clearcoat"},
                                                  {"fuzz", "fuzz_weight"},
                                                  {"sheen", "sheen_weight"},
                                                  {"sheen", "sheen"},
                                                  {"sheen", "sheen_color"},
                                                  {"transmission", "transmission_weight"},
                                                  {"transmission", "transmission"},
                                                  {"attenuation", "transmission"},
                                                  {"dispersion", "transmission"},
                                                  {"subsurface", "subsurface_weight"},
                                                  {"subsurface", "subsurface"},
                                                  {"thin_film", "thin_film_weight"},
                                                  {"thin_film", "thin_film_thickness"},
                                                  {"iridescence", "iridescence"},
                                                  {"emission", "emission_luminance"},
                                                  {"emission", "emission"},
                                                  {"emission", "emission_strength"},
                                                  {"emissive", "emissive_strength"}}};

void find_weights(std::vector<SurfaceInput>& inputs) {
  for (SurfaceInput& input : inputs)
    for (const auto& [prefix, weight] : kWeights) {
      const auto found = std::ranges::find(inputs, weight, &SurfaceInput::name);
      if (!input.name.starts_with(prefix) || found == inputs.end() || weight == input.name) continue;
      input.weight = static_cast<std::size_t>(found - inputs.begin());
      break;
    }
}

Tables make_tables() {
  Tables tables;
  add_surface<models::OpenPbrSurface>(Surface::kOpenPbr, tables);
  add_surface<models::StandardSurface>(Surface::kStandardSurface, tables);
  add_surface<models::GltfPbr>(Surface::kGltf, tables);
  add_surface<models::UsdPreviewSurface>(Surface::kUsdPreview, tables);
  add_surface<models::UsdPreviewSurface>(Surface::kUsdPreviewSpecular, tables);
  add_surface<models::Principled>(Surface::kPrincipled, tables);
  for (SurfaceInput& input : tables.surfaces[static_cast<std::size_t>(Surface::kUsdPreviewSpecular)]) {
    if (input.name == "useSpecularWorkflow") input.value = {1.0f, 1.0f, 1.0f};
    if (input.name == "specularColor") input.parameter = Parameter::kSpecular;
    if (input.name == "diffuseColor") input.parameter = Parameter::kDiffuse;
    if (input.name == "metallic") input.parameter = std::nullopt;
  }
  for (std::vector<SurfaceInput>& inputs : tables.surfaces) find_weights(inputs);
  return tables;
}

const Tables& tables() {
  static const Tables all = make_tables();
  return all;
}

constexpr NamedValues<Parameter, 10> kParameters = {
    {{Parameter::kRoughness, "width"},
     {Parameter::kSpecular, "specular"},
     {Parameter::kDiffuse, "diffuse"},
     {Parameter::kBaseColor, "base_color"},
     {Parameter::kMetallic, "metallic"},
     {Parameter::kMetalMask, "metal_mask"},
     {Parameter::kOcclusion, "occlusion"},
     {Parameter::kResidual, "residual"},
     {Parameter::kMetallicUncertainty, "metallic_uncertainty"},
     {Parameter::kMetallicIssues, "issues"}}};

const SurfaceInput& named_input(Parameter parameter) {
  return tables()
      .named[static_cast<std::size_t>(parameter) - static_cast<std::size_t>(Parameter::kFirstInput)];
}

}  // namespace

std::span<const SurfaceInput> inputs_of(Surface surface) {
  return tables().surfaces[static_cast<std::size_t>(surface)];
}

std::vector<Parameter> parameters_of(Surface surface) {
  std::vector<Parameter> parameters;
  for (const SurfaceInput& input : inputs_of(surface))
    if (input.parameter) parameters.push_back(*input.parameter);
  std::ranges::sort(parameters);
  return parameters;
}

std::optional<Parameter> parameter_named(std::string_view name) {
  constexpr std::array kOfWorkflows = {Parameter::kSpecular, Parameter::kDiffuse, Parameter::kMetalMask,
                                       Parameter::kOcclusion};
  for (const Parameter parameter : kOfWorkflows)
    if (parameter_name(parameter) == name) return parameter;
  if (name == "glossiness") return Parameter::kRoughness;
  const std::string_view common = common_name(name, 1);
  if (const auto shared = value_named(kShared, common)) return shared;
  const auto found = std::ranges::find(tables().named, common, &SurfaceInput::name);
  return found == tables().named.end() ? std::nullopt : found->parameter;
}

std::vector<std::string> parameter_names() {
  std::vector<std::string> names = {"roughness",  "glossiness", "specular",   "diffuse",
                                    "base_color", "metallic",   "metal_mask", "occlusion"};
  for (const SurfaceInput& input : tables().named) names.emplace_back(input.name);
  for (const SameInput& same : kSame)
    if (parameter_named(same.name)) names.emplace_back(same.name);
  return names;
}

std::string_view parameter_name(Parameter parameter) {
  return is_input(parameter) ? named_input(parameter).name : name_of(kParameters, parameter);
}

bool is_measure(Parameter parameter) {
  return parameter == Parameter::kResidual || parameter == Parameter::kMetallicUncertainty ||
         parameter == Parameter::kMetallicIssues;
}

std::string plain_name(Parameter parameter) {
  return parameter == Parameter::kRoughness ? "roughness" : std::string(parameter_name(parameter));
}

std::string parameter_option(Parameter parameter) {
  if (is_input(parameter) || parameter == Parameter::kMetalMask || parameter == Parameter::kOcclusion)
    return "--input " + plain_name(parameter);
  std::string option = "--" + plain_name(parameter);
  std::ranges::replace(option, '_', '-');
  return option;
}

bool is_color(Parameter parameter) {
  if (is_input(parameter)) return named_input(parameter).channels == 3;
  return parameter == Parameter::kSpecular || parameter == Parameter::kDiffuse ||
         parameter == Parameter::kBaseColor;
}

}  // namespace remap
