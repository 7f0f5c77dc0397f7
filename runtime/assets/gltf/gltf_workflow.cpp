#include "assets/gltf/gltf_workflow.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "assets/maps/map_pixels.hpp"
#include "core/errors.hpp"

namespace remap {
namespace {

constexpr std::array kCoreInputs = {GltfInput::kBaseColor,     GltfInput::kMetallic, GltfInput::kRoughness,
                                    GltfInput::kSpecularColor, GltfInput::kSpecular, GltfInput::kIor};
constexpr std::array kSpecGlossInputs = {GltfInput::kDiffuse, GltfInput::kSpecGlossSpecular,
                                         GltfInput::kGlossiness};

// New maps of color and of data resemble these textures, the best first.
constexpr std::array kCoreColors = {GltfInput::kBaseColor, GltfInput::kSpecularColor, GltfInput::kMetallic,
                                    GltfInput::kSpecular};
constexpr std::array kCoreData = {GltfInput::kMetallic, GltfInput::kSpecularColor, GltfInput::kSpecular,
                                  GltfInput::kBaseColor};
constexpr std::array kSpecGlossColors = {GltfInput::kDiffuse, GltfInput::kGlossiness};
constexpr std::array kSpecGlossData = {GltfInput::kGlossiness, GltfInput::kDiffuse};

std::span<const GltfInput> colors_of(GltfWorkflow workflow) {
  if (workflow == GltfWorkflow::kSpecGloss) return kSpecGlossColors;
  return kCoreColors;
}

std::span<const GltfInput> data_of(GltfWorkflow workflow) {
  if (workflow == GltfWorkflow::kSpecGloss) return kSpecGlossData;
  return kCoreData;
}

// Returns the parameter of the converter, or nothing for inputs that only contribute to F0.
std::optional<Parameter> parameter_of(GltfInput input) {
  switch (input) {
    case GltfInput::kBaseColor:
      return Parameter::kBaseColor;
    case GltfInput::kMetallic:
      return Parameter::kMetallic;
    case GltfInput::kRoughness:
    case GltfInput::kGlossiness:
      return Parameter::kRoughness;
    case GltfInput::kDiffuse:
      return Parameter::kDiffuse;
    case GltfInput::kSpecGlossSpecular:
      return Parameter::kSpecular;
    default:
      return std::nullopt;
  }
}

// Returns the F0 of the index times the color. It may exceed 1.
std::array<double, 3> unlimited_f0(const GltfMaterial& material) {
  std::array<double, 3> f0 = material.color(GltfInput::kSpecularColor);
  for (double& value : f0) value *= f0_of_index(material.number(GltfInput::kIor));
  return f0;
}

std::array<double, 3> f0_of(const GltfMaterial& material) {
  std::array<double, 3> f0 = unlimited_f0(material);
  for (double& value : f0) value = std::min(value, 1.0) * material.number(GltfInput::kSpecular);
  return f0;
}

std::vector<float> floats_of(const std::array<double, 3>& color) { return {color.begin(), color.end()}; }

SourceParameter source_of(GltfInput input, const GltfMaterial& material, const UsedTextures& used) {
  const GltfInputInfo& info = info_of(input);
  const std::string name(info.factor.substr(0, info.factor.rfind("Factor")));
  if (info.count > 1) return color_source(used.pixels_of(input), material.color(input), name.c_str());
  return value_source(used.pixels_of(input), info.channel, material.number(input), name.c_str());
}

}  // namespace

std::span<const GltfInput> inputs_of(GltfWorkflow workflow) {
  if (workflow == GltfWorkflow::kSpecGloss) return kSpecGlossInputs;
  const std::span<const GltfInput> core = kCoreInputs;
  return workflow == GltfWorkflow::kDielectric ? core : core.first(3);
}

GltfInput color_of(GltfWorkflow workflow) { return inputs_of(workflow).front(); }

GltfMaterial read_material(SpanValue material, GltfWorkflow workflow, std::vector<std::string>& warnings) {
  GltfMaterial read = read_inputs(material, inputs_of(workflow), warnings);
  const FactorText& ior = read[GltfInput::kIor].factor[0];
  if (ior.value > 0.0 && ior.value < 1.0)
    throw input_error("ior " + ior.text + ": expected 0, or a number of at least 1");
  return read;
}

std::unique_ptr<Converter> converter_of(GltfWorkflow workflow, const char* target,
                                        const AssetOptions& options) {
  return asset_converter(workflow == GltfWorkflow::kSpecGloss ? "gltf-specgloss" : "gltf", target,
                         options.prior, options.instructions, workflow == GltfWorkflow::kDielectric);
}

MaterialValues values_of(GltfWorkflow workflow, const GltfMaterial& material) {
  MaterialValues values;
  for (const GltfInput input : inputs_of(workflow)) {
    const std::optional<Parameter> parameter = parameter_of(input);
    if (!parameter) continue;
    if (input == GltfInput::kGlossiness)
      values[*parameter] = {roughness_of(material.number(input))};
    else if (info_of(input).count > 1)
      values[*parameter] = floats_of(material.color(input));
    else
      values[*parameter] = {static_cast<float>(material.number(input))};
  }
  if (workflow == GltfWorkflow::kDielectric) values[Parameter::kSpecular] = floats_of(f0_of(material));
  return values;
}

MaterialValues first_values_of(GltfWorkflow workflow, GltfMaterial material, const UsedTextures& used) {
  for (const UsedTexture& texture : used.textures) fold_first_texel(texture, inputs_of(workflow), material);
  return values_of(workflow, material);
}

GltfMaps::GltfMaps(GltfWorkflow workflow, const GltfMaterial& material, const UsedTextures& used)
    : color_model(used.first_of(colors_of(workflow))),
      data_model(used.first_of(data_of(workflow))),
      key(used.key()) {
  const GltfInput color = color_of(workflow);
  sources.color = used.pixels_of(color);
  sources.color_factors = material.color(color);
  sources.color_model = &color_model.pixels();
  sources.data_model = &data_model.pixels();
  MapConversion& conversion = sources.conversion;
  const bool is_specgloss = workflow == GltfWorkflow::kSpecGloss;
  conversion.source_convention =
      is_specgloss ? RoughnessEncoding::kGlossiness : RoughnessEncoding::kRoughness;
  for (const GltfInput input : inputs_of(workflow)) {
    if (const auto parameter = parameter_of(input))
      conversion.sources[*parameter] = source_of(input, material, used);
    for (std::size_t c = 0; c < std::min<std::size_t>(info_of(input).count, 3); ++c)
      key += " " + number_text(material[input].factor[c].value);
  }
  if (workflow != GltfWorkflow::kDielectric) return;
  const ImagePixels* const specular = used.pixels_of(GltfInput::kSpecular);
  const ImagePixels* const specular_color = used.pixels_of(GltfInput::kSpecularColor);
  const bool has_map = specular != nullptr || specular_color != nullptr;
  if (has_map)
    f0_ = f0_map(specular, material.number(GltfInput::kSpecular), specular_color, unlimited_f0(material));
  SourceParameter& f0 = conversion.sources[Parameter::kSpecular];
  f0 = color_source(has_map ? &f0_ : nullptr, f0_of(material), "specular");
  f0.transfer = Transfer::kLinear;
  if (has_map) f0.factors.clear();
}

MaterialTextures& require_images(MaterialTextures* textures) {
  if (textures == nullptr)
    throw input_error("has textures, but no reader of images was given (pass AssetResources)");
  return *textures;
}

std::optional<UsedTextures> used_textures(MaterialTextures* textures, GltfMaterial& material,
                                          std::span<const GltfInput> inputs, const GridReason& reason,
                                          std::vector<std::string>& warnings) {
  UsedTextures used = require_images(textures).load(material, inputs, reason, warnings);
  if (used.textures.empty()) return std::nullopt;
  return used;
}

}  // namespace remap
