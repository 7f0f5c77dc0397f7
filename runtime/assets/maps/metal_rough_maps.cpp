#include "assets/maps/metal_rough_maps.hpp"

#include <utility>

#include "assets/maps/map_pixels.hpp"

namespace remap {
namespace {

constexpr float kStep = 1.0f / 255.0f;

// Turns a channel that hardly varies into a factor, and fills it.
bool collapse(const ParameterStatistics& range, ImagePixels& pixels, std::size_t channel, float& factor) {
  if (range.max - range.min >= kStep) return false;
  factor = range.min + (range.max - range.min) / 2.0f;
  fill_channel(pixels, channel);
  return true;
}

}  // namespace

MetalRoughMaps metal_rough_maps(const Converter& converter, MetalRoughSources sources) {
  const bool has_alpha = sources.color != nullptr && sources.color->has_alpha();
  ImagePixels base = blank_like(*sources.color_model, has_alpha ? 4 : 3),
              data = blank_like(*sources.data_model, 3);
  MapConversion& conversion = sources.conversion;
  conversion.width = base.width;
  conversion.height = base.height;
  conversion.target_convention = RoughnessEncoding::kRoughness;
  conversion.value_statistics = true;
  conversion.targets[Parameter::kBaseColor] = color_target(base);
  conversion.targets[Parameter::kRoughness] = value_target(data, 1);
  conversion.targets[Parameter::kMetallic] = value_target(data, 2);
  MapStatistics statistics = convert_maps(converter, conversion);
  if (has_alpha) copy_alpha(*sources.color, base);

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

}  // namespace remap
