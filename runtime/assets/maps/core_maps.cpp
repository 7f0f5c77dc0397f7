#include "assets/maps/core_maps.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "assets/maps/map_pixels.hpp"

namespace remap {
namespace {

constexpr float kBlack = 1e-6f;

const ImagePixels* first_of(std::initializer_list<const ImagePixels*> maps) {
  for (const ImagePixels* const map : maps)
    if (map != nullptr) return map;
  return nullptr;
}

const ImagePixels* color_model_of(const CoreMaps& maps) {
  return first_of({maps.base, maps.specular_color, maps.metal_rough, maps.specular});
}

const ImagePixels* data_model_of(const CoreMaps& maps) {
  return first_of({maps.metal_rough, maps.specular_color, maps.specular, maps.base});
}

std::size_t alpha_of(const ImagePixels& pixels) { return pixels.channels - 1; }

// F0 as floats, texel by texel, which a product of two maps and a limit need.
ImagePixels f0_pixels(const CoreMaps& maps) {
  const ImagePixels& model = *first_of({maps.specular_color, maps.specular});
  const std::size_t texels = model.width * model.height;
  std::vector<float> specular(texels, 1.0f), color(texels), f0(3 * texels);
  const auto load_channel = [&](const ImagePixels& map, std::size_t channel, std::vector<float>& values) {
    load_values(map.type, map.bytes.data() + channel * byte_count(map.type), map.texel_bytes(), texels,
                values.data());
  };
  if (maps.specular != nullptr && maps.specular->has_alpha())
    load_channel(*maps.specular, alpha_of(*maps.specular), specular);
  for (std::size_t c = 0; c < 3; ++c) {
    std::ranges::fill(color, 1.0f);
    if (maps.specular_color != nullptr) {
      load_channel(*maps.specular_color, maps.specular_color->is_grey() ? 0 : c, color);
      to_linear(Transfer::kSrgb, color);
    }
    const auto most = static_cast<float>(maps.factors.f0_of_index * maps.factors.specular_color[c]);
    for (std::size_t i = 0; i < texels; ++i)
      f0[3 * i + c] =
          std::min(most * color[i], 1.0f) * static_cast<float>(maps.factors.specular) * specular[i];
  }
  ImagePixels pixels{model.width, model.height, 3, PixelType::kFloat, {}};
  pixels.bytes.resize(f0.size() * sizeof(float));
  (void)store_values(PixelType::kFloat, f0.data(), f0.size(), pixels.bytes.data(), sizeof(float));
  return pixels;
}

// `f0` outlives the conversion.
MapConversion core_conversion(const CoreMaps& maps, ImagePixels& f0) {
  MapConversion conversion;
  const ImagePixels& model = *color_model_of(maps);
  conversion.width = model.width;
  conversion.height = model.height;
  conversion.source_convention = RoughnessEncoding::kRoughness;
  conversion.sources[Parameter::kBaseColor] = color_source(maps.base, maps.factors.base_color, "base color");
  conversion.sources[Parameter::kRoughness] =
      value_source(maps.metal_rough, 1, maps.factors.roughness, "roughness");
  conversion.sources[Parameter::kMetallic] =
      value_source(maps.metal_rough, 2, maps.factors.metallic, "metallic");
  if (!maps.has_dielectric) return conversion;
  const bool has_f0_map = maps.specular != nullptr || maps.specular_color != nullptr;
  if (has_f0_map) f0 = f0_pixels(maps);
  SourceParameter& source = conversion.sources[Parameter::kSpecular];
  source = color_source(has_f0_map ? &f0 : nullptr, maps.factors.f0(), "specular");
  source.transfer = Transfer::kLinear;
  if (has_f0_map) source.factors.clear();
  return conversion;
}

}  // namespace

CoreFactors CoreMaps::first() const {
  CoreFactors texel = factors;
  if (base != nullptr)
    for (std::size_t c = 0; c < 3; ++c)
      texel.base_color[c] *= static_cast<double>(linear_of_srgb(first_texel(*base)[c]));
  if (metal_rough != nullptr) {
    texel.roughness *= static_cast<double>(first_texel(*metal_rough)[1]);
    texel.metallic *= static_cast<double>(first_texel(*metal_rough)[2]);
  }
  if (specular != nullptr) texel.specular *= static_cast<double>(first_texel(*specular)[3]);
  if (specular_color != nullptr)
    for (std::size_t c = 0; c < 3; ++c)
      texel.specular_color[c] *= static_cast<double>(linear_of_srgb(first_texel(*specular_color)[c]));
  return texel;
}

MetalRoughMaps folded(const CoreMaps& maps, const Converter& converter) {
  ImagePixels f0;
  MetalRoughSources sources;
  sources.conversion = core_conversion(maps, f0);
  sources.color = maps.base;
  sources.color_factors = maps.factors.base_color;
  sources.color_model = color_model_of(maps);
  sources.data_model = data_model_of(maps);
  return metal_rough_maps(converter, std::move(sources));
}

namespace {

bool are_flat(const ImagePixels& pixels, std::size_t first, std::size_t last) {
  for (std::size_t c = first; c <= last; ++c)
    if (!hardly_varies(pixels, c)) return false;
  return true;
}

// Diffuse as a factor, as the base map times one, or as a new map.
void settle_diffuse(const CoreMaps& maps, const std::vector<float>& first, ImagePixels diffuse,
                    SpecGlossImages& result) {
  const bool is_masked =
      maps.base != nullptr && maps.base->has_alpha() && !hardly_varies(*maps.base, alpha_of(*maps.base));
  const bool is_black = std::ranges::all_of(first, [](float value) { return value < kBlack; });
  if (are_flat(diffuse, 0, 2) && (!is_masked || is_black)) {
    result.keeps_base = is_masked;
    if (maps.base != nullptr && !is_masked) result.alpha = first_texel(*maps.base)[3];
    std::ranges::copy(first, result.diffuse_factors.begin());
  } else if (maps.base != nullptr && is_map_times(diffuse, *maps.base, maps.factors.base_color)) {
    result.keeps_base = true;
    std::ranges::copy(maps.factors.base_color, result.diffuse_factors.begin());
  } else {
    result.diffuse = std::move(diffuse);
  }
}

}  // namespace

SpecGlossImages specgloss_images(const CoreMaps& maps, const Converter& converter) {
  const bool has_alpha = maps.base != nullptr && maps.base->has_alpha();
  ImagePixels diffuse = blank_like(*color_model_of(maps), has_alpha ? 4 : 3),
              specgloss = blank_like(*data_model_of(maps), 4), f0;
  MapConversion conversion = core_conversion(maps, f0);
  conversion.target_convention = RoughnessEncoding::kGlossiness;
  conversion.targets[Parameter::kDiffuse] = color_target(diffuse);
  conversion.targets[Parameter::kSpecular] = color_target(specgloss);
  conversion.targets[Parameter::kRoughness] = value_target(specgloss, 3);
  (void)convert_maps(converter, conversion);
  if (has_alpha) copy_alpha(*maps.base, diffuse);

  SpecGlossImages result;
  const MaterialValues first = converted(converter, values_of(maps.first(), maps.has_dielectric));
  settle_diffuse(maps, first.at(Parameter::kDiffuse), std::move(diffuse), result);
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

}  // namespace remap
