#include "assets/maps/legacy_maps.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

#include "assets/maps/gltf_maps.hpp"
#include "assets/maps/map_pixels.hpp"
#include "core/number_text.hpp"
#include "remap/convert_maps.hpp"
#include "remap/pixels.hpp"
#include "stages/stage.hpp"

namespace remap {
namespace {

constexpr double kDielectricF0 = 0.04;

double mean_of(const std::array<double, 3>& color) { return (color[0] + color[1] + color[2]) / 3.0; }

// Returns the dielectric fraction of a mixture that reflects `diffuse` and `specular`. Both are means over
// channels.
double dielectric_share(double diffuse, double specular) {
  const double sum = diffuse + specular;
  const double root = std::sqrt(std::max(0.0, sum * sum - 4.0 * kDielectricF0 * diffuse));
  return sum + root > 0.0 ? std::min(1.0, 2.0 * diffuse / (sum + root)) : 1.0;
}

float exponent_of(const LegacyMaterial& material) {
  return static_cast<float>(
      std::clamp(material.exponent, LegacyMaterial::kLeastExponent, LegacyMaterial::kMostExponent));
}

// Return values as files store them, in floats.
double as_float(double value) { return static_cast<double>(static_cast<float>(value)); }
std::array<double, 3> as_floats(const std::array<double, 3>& color) {
  return {as_float(color[0]), as_float(color[1]), as_float(color[2])};
}

}  // namespace

double ggx_roughness(const LegacyMaterial& material) {
  return decimal_value(std::pow(1.55f / (exponent_of(material) + 4.17f), 0.25f));
}

std::array<double, 3> ggx_f0(const LegacyMaterial& material) {
  std::array<double, 3> f0{};
  for (std::size_t c = 0; c < 3; ++c)
    f0[c] = decimal_value(
        std::min(1.0f, 6.02f * static_cast<float>(material.specular[c]) / (exponent_of(material) + 1.86f)));
  return f0;
}

MetalRoughFactors core_of_legacy(const LegacyMaterial& material) {
  if (!material.has_highlight()) return {as_floats(material.diffuse), 0.0, 1.0};
  const std::array<double, 3> f0 = ggx_f0(material);
  const double share = dielectric_share(mean_of(material.diffuse), mean_of(f0));
  // If F0 is below a fortieth of core's F0, the result approaches the result without a highlight.
  const double matte = std::clamp(1.0 - 40.0 * *std::ranges::max_element(f0) / kDielectricF0, 0.0, 1.0);
  const double roughness = ggx_roughness(material);
  std::array<double, 3> base{};
  for (std::size_t c = 0; c < 3; ++c)
    base[c] = std::clamp(material.diffuse[c] + f0[c] - kDielectricF0 * share * (1.0 - matte), 0.0, 1.0);
  return {as_floats(base), as_float(1.0 - share), as_float(roughness + matte * (1.0 - roughness))};
}

LegacyDielectric dielectric_of_legacy(const LegacyMaterial& material) {
  // At least this fraction of light is transmitted to the diffuse lobe. Otherwise, a mirror would leave no
  // light for it. This was not measured for mirrors.
  constexpr double kLeastTransmitted = 0.02;
  const std::array<double, 3> f0 = ggx_f0(material);
  LegacyDielectric result;
  result.roughness = ggx_roughness(material);
  result.specular = *std::ranges::max_element(f0);
  for (std::size_t c = 0; c < 3; ++c) {
    result.base_color[c] =
        std::min(1.0, material.diffuse[c] / std::max(1.0 - result.specular, kLeastTransmitted));
    result.specular_color[c] = result.specular > 0.0 ? f0[c] / result.specular : 1.0;
  }
  return result;
}

namespace {

using FloatRow = std::vector<float>;

void load_channel(const ImagePixels& pixels, std::size_t channel, std::size_t y, float* values) {
  const std::size_t texel = pixels.texel_bytes();
  load_values(pixels.type, pixels.bytes.data() + y * pixels.width * texel + channel * byte_count(pixels.type),
              texel, pixels.width, values);
}

void store_channel(ImagePixels& pixels, std::size_t channel, std::size_t y, const float* values) {
  const std::size_t texel = pixels.texel_bytes();
  (void)store_values(pixels.type, values, pixels.width,
                     pixels.bytes.data() + y * pixels.width * texel + channel * byte_count(pixels.type),
                     texel);
}

// Converts diffuse, specular and an exponent to base color, metallic and roughness, and for a dielectric also
// to F0.
void convert_legacy(bool as_dielectric, Block& block) {
  const auto diffuse = block.color(Parameter::kDiffuse), specular = block.color(Parameter::kSpecular);
  const float* const exponent = block.row(Parameter::kRoughness);
  const auto base = block.make_color(Parameter::kBaseColor), f0 = block.make_color(Parameter::kSpecular);
  float* const metallic = block.make(Parameter::kMetallic);
  float* const roughness = block.make(Parameter::kRoughness);
  for (std::size_t i = 0; i < block.size(); ++i) {
    LegacyMaterial material;
    for (std::size_t c = 0; c < 3; ++c) {
      material.diffuse[c] = static_cast<double>(diffuse[c][i]);
      material.specular[c] = static_cast<double>(specular[c][i]);
    }
    material.exponent = static_cast<double>(exponent[i]);
    if (as_dielectric) {
      const LegacyDielectric result = dielectric_of_legacy(material);
      for (std::size_t c = 0; c < 3; ++c) {
        base[c][i] = static_cast<float>(result.base_color[c]);
        f0[c][i] = static_cast<float>(result.specular * result.specular_color[c]);
      }
      metallic[i] = 0.0f;
      roughness[i] = static_cast<float>(result.roughness);
    } else {
      const MetalRoughFactors result = core_of_legacy(material);
      for (std::size_t c = 0; c < 3; ++c) base[c][i] = static_cast<float>(result.base_color[c]);
      metallic[i] = static_cast<float>(result.metallic);
      roughness[i] = static_cast<float>(result.roughness);
    }
  }
}

Converter legacy_converter(bool as_dielectric) {
  ConverterInfo info;
  info.source.roughness = RoughnessEncoding::kExponent;
  info.target.roughness = RoughnessEncoding::kRoughness;
  std::vector<Parameter> targets = {Parameter::kRoughness, Parameter::kBaseColor, Parameter::kMetallic};
  if (as_dielectric) targets.insert(targets.begin() + 1, Parameter::kSpecular);
  return {std::move(info),
          {Parameter::kRoughness, Parameter::kSpecular, Parameter::kDiffuse},
          std::move(targets),
          {make_stage([as_dielectric](Block& block) { convert_legacy(as_dielectric, block); })}};
}

// Splits an F0 for KHR_materials_specular. Alpha is the largest channel of a texel, as a fraction of the
// largest value in the map. The color is F0 divided by that channel, in sRGB.
void settle_specular(const ImagePixels& f0, PixelType type, LegacyMapResult& result) {
  const std::size_t texels = f0.width * f0.height;
  std::vector<float> values(3 * texels), tints(texels);
  load_values(f0.type, f0.bytes.data(), sizeof(float), values.size(), values.data());
  const float largest = *std::ranges::max_element(values);
  ImagePixels pixels{f0.width, f0.height, 4, type, {}};
  pixels.bytes.resize(texels * pixels.texel_bytes());
  const auto store = [&](std::size_t channel) {
    (void)store_values(type, tints.data(), texels, pixels.bytes.data() + channel * byte_count(type),
                       pixels.texel_bytes());
  };
  const auto strength = [&](std::size_t i) {
    return std::max({values[3 * i], values[3 * i + 1], values[3 * i + 2]});
  };
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < texels; ++i)
      tints[i] = strength(i) > 0.0f ? values[3 * i + c] / strength(i) : 1.0f;
    from_linear(Transfer::kSrgb, tints);
    store(c);
  }
  for (std::size_t i = 0; i < texels; ++i) tints[i] = largest > 0.0f ? strength(i) / largest : 0.0f;
  store(3);
  result.specular_factor = static_cast<double>(largest);
  result.specular = std::move(pixels);
}

// A base color that hardly varies becomes a factor.
void settle_base(const LegacyMaps& maps, std::optional<ImagePixels> base, LegacyMapResult& result) {
  result.keeps_diffuse = !base;
  if (!base) {
    result.factors.base_color = maps.factors.diffuse;
  } else if (hardly_varies(*base, 0) && hardly_varies(*base, 1) && hardly_varies(*base, 2)) {
    const std::array<float, 4> texel = first_texel(*base);
    for (std::size_t c = 0; c < 3; ++c)
      result.factors.base_color[c] = static_cast<double>(linear_of_srgb(texel[c]));
  } else {
    result.base_color = std::move(base);
  }
}

}  // namespace

std::map<Parameter, SourceParameter> sources_of(const LegacyMaps& maps, ImagePixels& exponents) {
  if (maps.exponent != nullptr) exponents = scalar_map(*maps.exponent, maps.exponent_channel);
  return {{Parameter::kDiffuse, color_source(maps.diffuse.get(), maps.factors.diffuse, "diffuse")},
          {Parameter::kSpecular, color_source(maps.specular.get(), maps.factors.specular, "specular")},
          {Parameter::kRoughness, value_source(maps.exponent != nullptr ? &exponents : nullptr, 0,
                                               maps.factors.exponent, "exponent")}};
}

LegacyMapResult converted_maps(const LegacyMaps& maps) {
  const ImagePixels& model = maps.diffuse != nullptr    ? *maps.diffuse
                             : maps.specular != nullptr ? *maps.specular
                                                        : *maps.exponent;
  ImagePixels opaque, exponents, f0;
  MapSources sources;
  sources.color_model = sources.data_model = &model;
  sources.color = maps.diffuse.get();
  sources.color_factors = maps.factors.diffuse;
  if (maps.diffuse != nullptr && maps.diffuse->has_alpha()) {
    opaque = with_alpha(maps.diffuse.get(), nullptr, 'l');
    sources.color = &opaque;
  }
  MapConversion& conversion = sources.conversion;
  conversion.source_convention = RoughnessEncoding::kExponent;
  conversion.sources = sources_of(maps, exponents);
  if (maps.as_dielectric) {
    f0 = ImagePixels{model.width, model.height, 3, PixelType::kFloat, {}};
    f0.bytes.resize(f0.width * f0.height * f0.texel_bytes());
    conversion.targets[Parameter::kSpecular] = color_target(f0);
    conversion.targets[Parameter::kSpecular].transfer = Transfer::kLinear;
  }
  MetalRoughMaps made = metal_rough_maps(legacy_converter(maps.as_dielectric), std::move(sources));

  LegacyMapResult result;
  settle_base(maps, std::move(made.base_color), result);
  result.metal_rough = std::move(made.metal_rough);
  result.factors.metallic = static_cast<double>(made.metallic);
  result.factors.roughness = static_cast<double>(made.roughness);
  if (!maps.as_dielectric) return result;
  if (maps.specular != nullptr || maps.exponent != nullptr) {
    settle_specular(f0, model.type, result);
  } else {
    const LegacyDielectric dielectric = dielectric_of_legacy(maps.factors);
    result.specular_factor = dielectric.specular;
    result.specular_color = dielectric.specular_color;
  }
  return result;
}

ImagePixels channel_of(const ImagePixels& pixels, std::size_t channel) {
  ImagePixels grey{pixels.width, pixels.height, 1, pixels.type, {}};
  const std::size_t bytes = byte_count(pixels.type), texels = pixels.width * pixels.height;
  grey.bytes.resize(texels * bytes);
  for (std::size_t i = 0; i < texels; ++i)
    std::memcpy(grey.bytes.data() + i * bytes,
                pixels.bytes.data() + i * pixels.texel_bytes() + channel * bytes, bytes);
  return grey;
}

void load_scalar_row(const ImagePixels& pixels, char channel, std::size_t y, float* values) {
  constexpr std::string_view kColors = "rgb";
  if (channel == 'm' && pixels.has_alpha()) return load_channel(pixels, pixels.channels - 1, y, values);
  if (pixels.is_grey()) return load_channel(pixels, 0, y, values);
  const std::size_t color = kColors.find(channel);
  if (color != std::string_view::npos) return load_channel(pixels, color, y, values);
  // The luminance of the stored values uses these weights (ITU-R BT.709).
  constexpr std::array<float, 3> kWeights = {0.2126f, 0.7152f, 0.0722f};
  FloatRow row(pixels.width);
  std::fill(values, values + pixels.width, 0.0f);
  for (std::size_t c = 0; c < 3; ++c) {
    load_channel(pixels, c, y, row.data());
    for (std::size_t x = 0; x < pixels.width; ++x) values[x] += kWeights[c] * row[x];
  }
}

void set_channel(ImagePixels& pixels, std::size_t channel, const ImagePixels& from, char from_channel) {
  FloatRow row(pixels.width);
  for (std::size_t y = 0; y < pixels.height; ++y) {
    load_scalar_row(from, from_channel, y, row.data());
    store_channel(pixels, channel, y, row.data());
  }
}

ImagePixels scalar_map(const ImagePixels& pixels, char channel) {
  ImagePixels result{pixels.width, pixels.height, 1, PixelType::kFloat, {}};
  result.bytes.resize(result.width * result.height * sizeof(float));
  set_channel(result, 0, pixels, channel);
  return result;
}

ImagePixels with_levels(const ImagePixels& pixels, double base, double gain, bool with_alpha) {
  ImagePixels result = pixels;
  const std::size_t count = pixels.channels - (pixels.has_alpha() && !with_alpha ? 1 : 0);
  FloatRow row(pixels.width);
  for (std::size_t y = 0; y < pixels.height; ++y)
    for (std::size_t c = 0; c < count; ++c) {
      load_channel(pixels, c, y, row.data());
      for (float& value : row)
        value = static_cast<float>(std::clamp(base + gain * static_cast<double>(value), 0.0, 1.0));
      store_channel(result, c, y, row.data());
    }
  return result;
}

ImagePixels with_alpha(const ImagePixels* color, const ImagePixels* opacity, char channel) {
  ImagePixels result = blank_like(color != nullptr ? *color : *opacity, opacity != nullptr ? 4 : 3);
  FloatRow row(result.width);
  for (std::size_t y = 0; color != nullptr && y < result.height; ++y)
    for (std::size_t c = 0; c < 3; ++c) {
      load_channel(*color, color->is_grey() ? 0 : c, y, row.data());
      store_channel(result, c, y, row.data());
    }
  if (opacity != nullptr) set_channel(result, 3, *opacity, channel);
  return result;
}

}  // namespace remap
