#include "assets/maps/legacy_maps.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "assets/maps/map_pixels.hpp"
#include "remap/pixels.hpp"

namespace remap {
namespace {

constexpr float kStepOf8Bits = 1.0f / 255.0f;

using FloatRow = std::vector<float>;
using ColorRow = std::array<FloatRow, 3>;

ColorRow color_row(std::size_t width) {
  ColorRow row;
  row.fill(FloatRow(width));
  return row;
}

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

// Linear colors of a map times their factors; without a map the factors.
void load_color(const ImagePixels* pixels, const std::array<double, 3>& factors, std::size_t y,
                ColorRow& row) {
  for (std::size_t c = 0; c < 3; ++c) {
    const auto factor = static_cast<float>(factors[c]);
    std::ranges::fill(row[c], 1.0f);
    if (pixels != nullptr) {
      load_channel(*pixels, pixels->is_grey() ? 0 : c, y, row[c].data());
      to_linear(Transfer::kSrgb, row[c]);
    }
    for (float& value : row[c]) value *= factor;
  }
}

struct ValueRange {
  float least = 1.0f, most = 0.0f;
  void add(const FloatRow& row) {
    const auto [low, high] = std::ranges::minmax(row);
    least = std::min(least, low);
    most = std::max(most, high);
  }
  bool is_constant() const { return most - least < kStepOf8Bits; }
  float middle() const { return least + (most - least) / 2.0f; }
};

class LegacyMapPass {
 public:
  explicit LegacyMapPass(const LegacyMaps& maps)
      : maps_(maps),
        color_(maps.diffuse != nullptr    ? *maps.diffuse
               : maps.specular != nullptr ? *maps.specular
                                          : *maps.exponent),
        width_(color_.width),
        base_(blank_like(color_, 3)),
        data_(blank_like(color_, 3)),
        specular_(blank_like(color_, maps.as_dielectric ? 4 : 0)),
        diffuse_row_(color_row(width_)),
        specular_row_(color_row(width_)),
        base_row_(color_row(width_)),
        tint_row_(color_row(width_)),
        exponent_row_(width_),
        metallic_row_(width_),
        roughness_row_(width_),
        strength_row_(width_) {
    // The specular map may be of any strength; eight bits of alpha hold shares of the strongest.
    LegacyMaterial strongest = maps.factors;
    if (maps.exponent != nullptr) strongest.exponent = LegacyMaterial::kLeastExponent;
    if (maps.as_dielectric) largest_ = dielectric_of_legacy(strongest).specular;
  }

  LegacyMapResult run() {
    if (maps_.as_dielectric) find_largest();
    for (std::size_t y = 0; y < color_.height; ++y) {
      load(y);
      convert();
      store(y);
    }
    return result();
  }

 private:
  void load(std::size_t y) {
    load_color(maps_.diffuse, maps_.factors.diffuse, y, diffuse_row_);
    load_color(maps_.specular, maps_.factors.specular, y, specular_row_);
    std::ranges::fill(exponent_row_, 1.0f);
    if (maps_.exponent != nullptr)
      load_scalar_row(*maps_.exponent, maps_.exponent_channel, y, exponent_row_.data());
  }

  LegacyMaterial material_at(std::size_t x) const {
    LegacyMaterial material;
    for (std::size_t c = 0; c < 3; ++c) {
      material.diffuse[c] = static_cast<double>(diffuse_row_[c][x]);
      material.specular[c] = static_cast<double>(specular_row_[c][x]);
    }
    material.exponent = maps_.factors.exponent * static_cast<double>(exponent_row_[x]);
    return material;
  }

  void find_largest() {
    double largest = 0.0;
    for (std::size_t y = 0; y < color_.height && largest < largest_; ++y) {
      load(y);
      for (std::size_t x = 0; x < width_; ++x)
        largest = std::max(largest, dielectric_of_legacy(material_at(x)).specular);
    }
    largest_ = std::min(largest, largest_);
  }

  void convert() {
    for (std::size_t x = 0; x < width_; ++x) {
      if (maps_.as_dielectric) {
        const LegacyDielectric result = dielectric_of_legacy(material_at(x));
        for (std::size_t c = 0; c < 3; ++c) {
          base_row_[c][x] = static_cast<float>(result.base_color[c]);
          tint_row_[c][x] = static_cast<float>(result.specular_color[c]);
        }
        strength_row_[x] = largest_ > 0.0 ? static_cast<float>(result.specular / largest_) : 0.0f;
        roughness_row_[x] = static_cast<float>(result.roughness);
      } else {
        const MetalRoughFactors result = core_of_legacy(material_at(x));
        for (std::size_t c = 0; c < 3; ++c) base_row_[c][x] = result.base_color[c];
        metallic_row_[x] = result.metallic;
        roughness_row_[x] = result.roughness;
      }
    }
  }

  void store(std::size_t y) {
    for (std::size_t c = 0; c < 3; ++c) {
      from_linear(Transfer::kSrgb, base_row_[c]);
      base_range_[c].add(base_row_[c]);
      from_linear(Transfer::kSrgb, diffuse_row_[c]);
      for (std::size_t x = 0; x < width_; ++x)
        farthest_ = std::max(farthest_, std::fabs(base_row_[c][x] - diffuse_row_[c][x]));
      store_channel(base_, c, y, base_row_[c].data());
      if (maps_.as_dielectric) {
        from_linear(Transfer::kSrgb, tint_row_[c]);
        store_channel(specular_, c, y, tint_row_[c].data());
      }
    }
    roughness_range_.add(roughness_row_);
    metallic_range_.add(metallic_row_);
    store_channel(data_, 1, y, roughness_row_.data());
    store_channel(data_, 2, y, metallic_row_.data());
    if (maps_.as_dielectric) store_channel(specular_, 3, y, strength_row_.data());
  }

  // Turns a channel that hardly varies into a factor, and fills it.
  static double collapsed(const ValueRange& range, ImagePixels& pixels, std::size_t channel) {
    const FloatRow full(pixels.width, 1.0f);
    for (std::size_t y = 0; y < pixels.height; ++y) store_channel(pixels, channel, y, full.data());
    return static_cast<double>(range.middle());
  }

  LegacyMapResult result() {
    LegacyMapResult result;
    result.specular_factor = largest_;
    result.keeps_diffuse = maps_.diffuse != nullptr && farthest_ <= kStepOf8Bits;
    const bool is_base_constant = std::ranges::all_of(base_range_, &ValueRange::is_constant);
    if (result.keeps_diffuse)
      result.base = maps_.factors.diffuse;
    else if (is_base_constant)
      for (std::size_t c = 0; c < 3; ++c)
        result.base[c] = static_cast<double>(linear_of_srgb(base_range_[c].middle()));
    else
      result.base_color = std::move(base_);
    const bool is_rough = roughness_range_.is_constant(), is_metal = metallic_range_.is_constant();
    if (is_rough) result.roughness = collapsed(roughness_range_, data_, 1);
    if (is_metal) result.metallic = collapsed(metallic_range_, data_, 2);
    if (!is_rough || !is_metal) result.metal_rough = std::move(data_);
    const bool is_specular_constant = maps_.specular == nullptr && maps_.exponent == nullptr;
    if (maps_.as_dielectric && is_specular_constant)
      result.specular_color = dielectric_of_legacy(maps_.factors).specular_color;
    else if (maps_.as_dielectric)
      result.specular = std::move(specular_);
    return result;
  }

  const LegacyMaps& maps_;
  const ImagePixels& color_;  // whose size and type the results have
  std::size_t width_;
  ImagePixels base_, data_, specular_;
  ColorRow diffuse_row_, specular_row_, base_row_, tint_row_;
  FloatRow exponent_row_, metallic_row_, roughness_row_, strength_row_;
  std::array<ValueRange, 3> base_range_;  // as stored
  ValueRange metallic_range_, roughness_range_;
  float farthest_ = 0.0f;  // of base color from the diffuse map, as stored
  double largest_ = 0.0;   // specular of a dielectric
};

}  // namespace

LegacyMapResult converted_maps(const LegacyMaps& maps) { return LegacyMapPass(maps).run(); }

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
  // Luminance of the stored values (ITU-R BT.709).
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
