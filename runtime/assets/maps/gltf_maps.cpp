#include "assets/maps/gltf_maps.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "assets/maps/map_pixels.hpp"
#include "stages/stage.hpp"

namespace remap {
namespace {

constexpr float kStep = 1.0f / 255.0f, kBlack = 1e-6f;

// Turns a channel that hardly varies into a factor, and fills the channel.
bool collapse(const ParameterStatistics& range, ImagePixels& pixels, std::size_t channel, float& factor) {
  if (range.max - range.min >= kStep) return false;
  factor = range.min + (range.max - range.min) / 2.0f;
  fill_channel(pixels, channel);
  return true;
}

bool has_alpha(const MapSources& sources) { return sources.color != nullptr && sources.color->has_alpha(); }

// Converts into `color`, which gets the alpha of the color map.
MapStatistics convert(const Converter& converter, MapSources& sources, ImagePixels& color) {
  sources.conversion.width = color.width;
  sources.conversion.height = color.height;
  MapStatistics statistics = convert_maps(converter, sources.conversion);
  if (has_alpha(sources)) copy_alpha(*sources.color, color);
  return statistics;
}

std::vector<float> values_of_channel(const ImagePixels& pixels, std::size_t channel) {
  std::vector<float> values(pixels.width * pixels.height);
  load_values(pixels.type, pixels.bytes.data() + channel * byte_count(pixels.type), pixels.texel_bytes(),
              values.size(), values.data());
  return values;
}

bool are_flat(const ImagePixels& pixels, std::size_t first, std::size_t last) {
  for (std::size_t c = first; c <= last; ++c)
    if (!hardly_varies(pixels, c)) return false;
  return true;
}

// Stores diffuse as a factor, as the color map times a factor, or as a new map.
void settle_diffuse(const MapSources& sources, const std::vector<float>& first, ImagePixels diffuse,
                    SpecGlossMaps& result) {
  const ImagePixels* const color = sources.color;
  const bool is_masked = has_alpha(sources) && !hardly_varies(*color, color->channels - 1);
  const bool is_black = std::ranges::all_of(first, [](float value) { return value < kBlack; });
  if (are_flat(diffuse, 0, 2) && (!is_masked || is_black)) {
    result.keeps_color = is_masked;
    if (color != nullptr && !is_masked) result.alpha = first_texel(*color)[3];
    std::ranges::copy(first, result.diffuse_factors.begin());
  } else if (color != nullptr && is_map_times(diffuse, *color, sources.color_factors)) {
    result.keeps_color = true;
    std::ranges::copy(sources.color_factors, result.diffuse_factors.begin());
  } else {
    result.diffuse = std::move(diffuse);
  }
}

}  // namespace

MetalRoughMaps metal_rough_maps(const Converter& converter, MapSources sources) {
  ImagePixels base = blank_like(*sources.color_model, has_alpha(sources) ? 4 : 3),
              data = blank_like(*sources.data_model, 3);
  MapConversion& conversion = sources.conversion;
  conversion.target_convention = RoughnessEncoding::kRoughness;
  conversion.value_statistics = true;
  conversion.targets[Parameter::kBaseColor] = color_target(base);
  conversion.targets[Parameter::kRoughness] = value_target(data, 1);
  conversion.targets[Parameter::kMetallic] = value_target(data, 2);
  MapStatistics statistics = convert(converter, sources, base);

  MetalRoughMaps result;
  result.has_metal = statistics.targets[Parameter::kMetallic].max > 0.0f;
  result.residual = sampled_residual(converter, std::move(conversion));
  const bool is_rough = collapse(statistics.targets[Parameter::kRoughness], data, 1, result.roughness);
  const bool is_metal = collapse(statistics.targets[Parameter::kMetallic], data, 2, result.metallic);
  if (!is_rough || !is_metal) result.metal_rough = std::move(data);
  if (sources.color == nullptr || !is_map_times(base, *sources.color, sources.color_factors))
    result.base_color = std::move(base);
  return result;
}

SpecGlossMaps specgloss_maps(const Converter& converter, MapSources sources, const MaterialValues& first) {
  ImagePixels diffuse = blank_like(*sources.color_model, has_alpha(sources) ? 4 : 3),
              specgloss = blank_like(*sources.data_model, 4);
  MapConversion& conversion = sources.conversion;
  conversion.target_convention = RoughnessEncoding::kGlossiness;
  conversion.targets[Parameter::kDiffuse] = color_target(diffuse);
  conversion.targets[Parameter::kSpecular] = color_target(specgloss);
  conversion.targets[Parameter::kRoughness] = value_target(specgloss, 3);
  (void)convert(converter, sources, diffuse);

  SpecGlossMaps result;
  settle_diffuse(sources, first.at(Parameter::kDiffuse), std::move(diffuse), result);
  const bool has_color = !are_flat(specgloss, 0, 2), has_gloss = !are_flat(specgloss, 3, 3);
  if (!has_color) {
    std::ranges::copy(first.at(Parameter::kSpecular), result.specular.begin());
    for (std::size_t c = 0; c < 3; ++c) fill_channel(specgloss, c);
  }
  if (!has_gloss) {
    result.glossiness = 1.0f - first.at(Parameter::kRoughness)[0];
    fill_channel(specgloss, 3);
  }
  if (has_color || has_gloss) result.specgloss = std::move(specgloss);
  return result;
}

ImagePixels roughness_map(const ImagePixels& specgloss, double glossiness) {
  ImagePixels result = blank_like(specgloss, 3);
  std::vector<float> values = values_of_channel(specgloss, specgloss.channels - 1);
  for (float& value : values) value = 1.0f - static_cast<float>(glossiness) * value;
  (void)store_values(result.type, values.data(), values.size(), result.bytes.data() + byte_count(result.type),
                     result.texel_bytes());
  return result;
}

ImagePixels f0_map(const ImagePixels* specular, double specular_factor, const ImagePixels* color,
                   const std::array<double, 3>& most) {
  const ImagePixels& model = color != nullptr ? *color : *specular;
  const std::size_t texels = model.width * model.height;
  std::vector<float> strengths(texels, 1.0f), colors(texels, 1.0f), f0(3 * texels);
  if (specular != nullptr && specular->has_alpha())
    strengths = values_of_channel(*specular, specular->channels - 1);
  for (std::size_t c = 0; c < 3; ++c) {
    if (color != nullptr) {
      colors = values_of_channel(*color, color->is_grey() ? 0 : c);
      to_linear(Transfer::kSrgb, colors);
    }
    for (std::size_t i = 0; i < texels; ++i)
      f0[3 * i + c] = std::min(static_cast<float>(most[c]) * colors[i], 1.0f) *
                      static_cast<float>(specular_factor) * strengths[i];
  }
  ImagePixels pixels{model.width, model.height, 3, PixelType::kFloat, {}};
  pixels.bytes.resize(f0.size() * sizeof(float));
  (void)store_values(PixelType::kFloat, f0.data(), f0.size(), pixels.bytes.data(), sizeof(float));
  return pixels;
}

MaterialValues converted(const Converter& converter, const MaterialValues& material) {
  MaterialRows<const float> in;
  for (const auto& [parameter, values] : material) {
    in[parameter].count = values.size();
    for (std::size_t c = 0; c < values.size(); ++c) in[parameter].row[c] = &values[c];
  }
  MaterialValues result;
  MaterialRows<float> out;
  for (const Parameter parameter : converter.targets()) {
    std::vector<float>& values = result[parameter];
    values.resize(is_color(parameter) ? 3 : 1);
    out[parameter].count = values.size();
    for (std::size_t c = 0; c < values.size(); ++c) out[parameter].row[c] = &values[c];
  }
  converter.convert(1, in, out);
  return result;
}

std::unique_ptr<Converter> asset_converter(const char* source, const char* target, double prior,
                                           InstructionSet set, bool has_dielectric) {
  WorkflowStages stages{find_workflow_model(source)->end, find_workflow_model(target)->end};
  stages.width = RoughnessEncoding::kRoughness;
  stages.prior = prior;
  return has_dielectric ? make_dielectric_converter(stages, set) : make_workflow_converter(stages, set);
}

float roughness_of(double glossiness) { return static_cast<float>(1.0 - glossiness); }

double f0_of_index(double ior) {
  const double root = ior == 0.0 ? 1.0 : (ior - 1.0) / (ior + 1.0);
  return root * root;
}

}  // namespace remap
