#include "assets/maps/map_pixels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

namespace remap {
namespace {

// Returns a table of map times factor, for each stored value.
std::vector<std::uint32_t> expected_values(PixelType type, float factor) {
  const std::size_t count = type == PixelType::kUint16 ? 65536 : 256;
  const float largest = static_cast<float>(count - 1);
  std::vector<float> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<float>(i) / largest;
  to_linear(Transfer::kSrgb, values);
  for (float& value : values) value *= factor;
  from_linear(Transfer::kSrgb, values);
  std::vector<std::uint32_t> stored(count);
  for (std::size_t i = 0; i < count; ++i)
    stored[i] = static_cast<std::uint32_t>(std::lround(std::clamp(values[i], 0.0f, 1.0f) * largest));
  return stored;
}

std::uint32_t stored_at(const std::byte* first, PixelType type) {
  if (type == PixelType::kUint8) return std::to_integer<std::uint32_t>(*first);
  std::uint16_t value = 0;
  std::memcpy(&value, first, sizeof value);
  return value;
}

std::vector<float> floats_of(const std::array<double, 3>& values) {
  return {static_cast<float>(values[0]), static_cast<float>(values[1]), static_cast<float>(values[2])};
}

}  // namespace

ImagePixels blank_like(const ImagePixels& model, std::size_t channels) {
  ImagePixels pixels{model.width, model.height, channels, model.type, {}};
  pixels.bytes.assign(pixels.width * pixels.height * pixels.texel_bytes(), std::byte{255});
  return pixels;
}

bool is_constant(const ImagePixels& pixels) {
  const std::size_t size = pixels.texel_bytes();
  // Compares every byte with the byte one texel before. All are equal if the map is constant.
  return pixels.bytes.size() <= size ||
         std::memcmp(pixels.bytes.data(), pixels.bytes.data() + size, pixels.bytes.size() - size) == 0;
}

bool hardly_varies(const ImagePixels& pixels, std::size_t channel) {
  const std::uint32_t step = pixels.type == PixelType::kUint16 ? 257 : 1;
  const std::byte* const first = pixels.bytes.data() + channel * byte_count(pixels.type);
  std::uint32_t least = stored_at(first, pixels.type), most = least;
  for (std::size_t i = 1; i < pixels.width * pixels.height && most - least <= step; ++i) {
    const std::uint32_t value = stored_at(first + i * pixels.texel_bytes(), pixels.type);
    least = std::min(least, value);
    most = std::max(most, value);
  }
  return most - least <= step;
}

std::array<float, 4> first_texel(const ImagePixels& pixels) {
  std::array<float, 4> stored{}, texel{};
  load_values(pixels.type, pixels.bytes.data(), byte_count(pixels.type), pixels.channels, stored.data());
  for (std::size_t c = 0; c < 3; ++c) texel[c] = stored[pixels.is_grey() ? 0 : c];
  texel[3] = pixels.has_alpha() ? stored[pixels.channels - 1] : 1.0f;
  return texel;
}

float linear_of_srgb(float value) {
  to_linear(Transfer::kSrgb, {&value, 1});
  return value;
}

SourceParameter color_source(const ImagePixels* pixels, const std::array<double, 3>& factors,
                             const char* name) {
  SourceParameter source;
  source.name = name;
  if (pixels == nullptr) {
    source.constants = floats_of(factors);
    return source;
  }
  for (std::size_t c = 0; c < (pixels->is_grey() ? 1u : 3u); ++c) {
    source.channels.push_back(channel_of_pixels(*pixels, c));
    source.channel_names.emplace_back(1, "RGB"[c]);
  }
  // A grey map needs three channels if the factors differ.
  if (pixels->is_grey())
    for (std::size_t c = 1; c < 3; ++c) {
      source.channels.push_back(channel_of_pixels(*pixels, 0));
      source.channel_names.emplace_back("R");
    }
  source.factors = floats_of(factors);
  source.transfer = Transfer::kSrgb;
  return source;
}

SourceParameter value_source(const ImagePixels* pixels, std::size_t channel, double factor,
                             const char* name) {
  SourceParameter source;
  source.name = name;
  const bool is_alpha = channel == 3;
  if (pixels == nullptr || (is_alpha && !pixels->has_alpha())) {
    source.constants = {static_cast<float>(factor)};
    return source;
  }
  const std::size_t own = is_alpha ? pixels->channels - 1 : (pixels->is_grey() ? 0 : channel);
  source.channels = {channel_of_pixels(*pixels, own)};
  source.channel_names = {std::string(1, "RGBA"[channel])};
  source.factors = {static_cast<float>(factor)};
  return source;
}

TargetParameter color_target(ImagePixels& pixels) {
  return {{channel_of_pixels(pixels, 0), channel_of_pixels(pixels, 1), channel_of_pixels(pixels, 2)},
          Transfer::kSrgb};
}

TargetParameter value_target(ImagePixels& pixels, std::size_t channel) {
  return {{channel_of_pixels(pixels, channel)}, Transfer::kLinear};
}

bool is_map_times(const ImagePixels& result, const ImagePixels& map, const std::array<double, 3>& factors) {
  const std::size_t texels = result.width * result.height, bytes = byte_count(result.type);
  const std::uint32_t step = result.type == PixelType::kUint16 ? 257 : 1;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::vector<std::uint32_t> expected = expected_values(result.type, static_cast<float>(factors[c]));
    const std::byte* own = result.bytes.data() + c * bytes;
    const std::byte* other = map.bytes.data() + (map.is_grey() ? 0 : c * bytes);
    for (std::size_t i = 0; i < texels; ++i) {
      const std::uint32_t value = stored_at(own + i * result.texel_bytes(), result.type),
                          wanted = expected[stored_at(other + i * map.texel_bytes(), map.type)];
      if (value > wanted + step || wanted > value + step) return false;
    }
  }
  return true;
}

bool NormalShares::are_normals() const {
  return unit > 0.9 && inwards < 0.02 && std::fabs(mean[0] - 0.5) < 0.1 && std::fabs(mean[1] - 0.5) < 0.1;
}

NormalShares normal_shares(const std::array<std::span<const float>, 3>& rgb) {
  constexpr float kUnit = 0.12f, kInwards = -0.1f;
  NormalShares shares;
  const std::size_t count = rgb[0].size();
  for (std::size_t i = 0; i < count; ++i) {
    const float x = 2.0f * rgb[0][i] - 1.0f, y = 2.0f * rgb[1][i] - 1.0f, z = 2.0f * rgb[2][i] - 1.0f;
    shares.unit += std::fabs(std::sqrt(x * x + y * y + z * z) - 1.0f) < kUnit;
    shares.inwards += z < kInwards;
    for (std::size_t c = 0; c < 3; ++c) shares.mean[c] += static_cast<double>(rgb[c][i]);
  }
  const double n = static_cast<double>(std::max<std::size_t>(1, count));
  shares.unit /= n;
  shares.inwards /= n;
  for (double& mean : shares.mean) mean /= n;
  return shares;
}

bool holds_normals(const ImagePixels& pixels) {
  if (pixels.is_grey()) return false;
  constexpr std::size_t kMostAlong = 256;
  const std::size_t step = (std::max(pixels.width, pixels.height) + kMostAlong - 1) / kMostAlong;
  std::array<std::vector<float>, 3> planes;
  for (std::size_t y = 0; y < pixels.height; y += step)
    for (std::size_t x = 0; x < pixels.width; x += step) {
      std::array<float, 4> texel{};
      load_values(pixels.type, pixels.bytes.data() + (y * pixels.width + x) * pixels.texel_bytes(),
                  byte_count(pixels.type), pixels.channels, texel.data());
      for (std::size_t c = 0; c < 3; ++c) planes[c].push_back(texel[c]);
    }
  return normal_shares({planes[0], planes[1], planes[2]}).are_normals();
}

void copy_alpha(const ImagePixels& from, ImagePixels& to) {
  (void)copy_channel(channel_of_pixels(from, from.channels - 1), channel_of_pixels(to, to.channels - 1),
                     from.width, from.height);
}

void fill_channel(ImagePixels& pixels, std::size_t channel) {
  const std::size_t bytes = byte_count(pixels.type);
  for (std::size_t i = 0; i < pixels.width * pixels.height; ++i)
    std::memset(pixels.bytes.data() + i * pixels.texel_bytes() + channel * bytes, 255, bytes);
}

double sampled_residual(const Converter& converter, MapConversion conversion) {
  constexpr std::size_t kMostAlong = 128;
  const std::size_t step = (std::max(conversion.width, conversion.height) + kMostAlong - 1) / kMostAlong;
  conversion.width = (conversion.width + step - 1) / step;
  conversion.height = (conversion.height + step - 1) / step;
  for (auto& [parameter, source] : conversion.sources)
    for (ConstChannelView& channel : source.channels) {
      channel.texel_stride *= static_cast<std::ptrdiff_t>(step);
      channel.row_stride *= static_cast<std::ptrdiff_t>(step);
    }
  conversion.targets.clear();
  conversion.value_statistics = false;
  conversion.metallic_statistics = true;
  return convert_maps(converter, conversion).metallic.rms_residual();
}

}  // namespace remap
