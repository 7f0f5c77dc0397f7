#include "assets/maps/specgloss_maps.hpp"

#include <utility>
#include <vector>

#include "assets/maps/map_pixels.hpp"

namespace remap {

MetalRoughMaps projected(const SpecGlossMaps& maps, const Converter& projection) {
  MetalRoughSources sources;
  sources.color = maps.diffuse;
  sources.color_factors = maps.factors.diffuse;
  sources.color_model = maps.diffuse != nullptr ? maps.diffuse : maps.specgloss;
  sources.data_model = maps.specgloss != nullptr ? maps.specgloss : maps.diffuse;
  MapConversion& conversion = sources.conversion;
  conversion.sources[Parameter::kDiffuse] = color_source(maps.diffuse, maps.factors.diffuse, "diffuse");
  conversion.sources[Parameter::kSpecular] = color_source(maps.specgloss, maps.factors.specular, "specular");
  conversion.sources[Parameter::kRoughness] =
      value_source(maps.specgloss, 3, maps.factors.glossiness, "glossiness");
  conversion.source_convention = RoughnessEncoding::kGlossiness;
  return metal_rough_maps(projection, std::move(sources));
}

ImagePixels roughness_map(const ImagePixels& specgloss, double glossiness) {
  ImagePixels result = blank_like(specgloss, 3);
  const std::size_t texels = result.width * result.height, bytes = byte_count(result.type);
  std::vector<float> values(texels);
  load_values(specgloss.type, specgloss.bytes.data() + (specgloss.channels - 1) * bytes,
              specgloss.texel_bytes(), texels, values.data());
  for (float& value : values) value = 1.0f - static_cast<float>(glossiness) * value;
  (void)store_values(result.type, values.data(), texels, result.bytes.data() + bytes, result.texel_bytes());
  return result;
}

}  // namespace remap
