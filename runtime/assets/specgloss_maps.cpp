#include "assets/specgloss_maps.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

#include "remap/convert_maps.hpp"

namespace remap {
namespace {

constexpr float kStep = 1.0f / 255.0f;

// Of constant pixels one to read, of others one to write.
template <typename Pixels>
auto channel_of_pixels(Pixels& pixels, std::size_t channel) {
  const auto texel = static_cast<std::ptrdiff_t>(pixels.texel_bytes());
  using Byte = std::remove_pointer_t<decltype(pixels.bytes.data())>;
  return BasicChannelView<Byte>{pixels.bytes.data() + channel * byte_count(pixels.type), pixels.type, texel,
                                texel * static_cast<std::ptrdiff_t>(pixels.width)};
}

// Every value is the largest.
ImagePixels blank_like(const ImagePixels& model, std::size_t channels) {
  ImagePixels pixels{model.width, model.height, channels, model.type, {}};
  pixels.bytes.assign(pixels.width * pixels.height * pixels.texel_bytes(), std::byte{255});
  return pixels;
}

std::vector<float> floats_of(const std::array<double, 3>& values) {
  return {static_cast<float>(values[0]), static_cast<float>(values[1]), static_cast<float>(values[2])};
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
  // A grey map whose factors differ has three channels.
  if (pixels->is_grey())
    for (std::size_t c = 1; c < 3; ++c) {
      source.channels.push_back(channel_of_pixels(*pixels, 0));
      source.channel_names.emplace_back("R");
    }
  source.factors = floats_of(factors);
  source.transfer = Transfer::kSrgb;
  return source;
}

SourceParameter glossiness_source(const ImagePixels* pixels, double factor) {
  SourceParameter source;
  source.name = "glossiness";
  if (pixels == nullptr || !pixels->has_alpha()) {
    source.constants = {static_cast<float>(factor)};
    return source;
  }
  source.channels = {channel_of_pixels(*pixels, pixels->channels - 1)};
  source.channel_names = {"A"};
  source.factors = {static_cast<float>(factor)};
  return source;
}

// What the diffuse map times its factor is for each stored value.
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

// Whether base color is the diffuse map times its factor, within a step of 8 bits.
bool is_diffuse(const ImagePixels& base, const ImagePixels& diffuse, const std::array<double, 3>& factors) {
  const std::size_t texels = base.width * base.height, bytes = byte_count(base.type);
  const std::uint32_t step = base.type == PixelType::kUint16 ? 257 : 1;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::vector<std::uint32_t> expected = expected_values(base.type, static_cast<float>(factors[c]));
    const std::byte* own = base.bytes.data() + c * bytes;
    const std::byte* other = diffuse.bytes.data() + (diffuse.is_grey() ? 0 : c * bytes);
    for (std::size_t i = 0; i < texels; ++i) {
      const std::uint32_t value = stored_at(own + i * base.texel_bytes(), base.type),
                          wanted = expected[stored_at(other + i * diffuse.texel_bytes(), diffuse.type)];
      if (value > wanted + step || wanted > value + step) return false;
    }
  }
  return true;
}

void copy_alpha(const ImagePixels& from, ImagePixels& to) {
  (void)copy_channel(channel_of_pixels(from, from.channels - 1), channel_of_pixels(to, to.channels - 1),
                     from.width, from.height);
}

// Turns a channel that hardly varies into a factor, and fills it.
bool collapse(const ParameterStatistics& range, ImagePixels& pixels, std::size_t channel, float& factor) {
  if (range.max - range.min >= kStep) return false;
  factor = range.min + (range.max - range.min) / 2.0f;
  const std::size_t bytes = byte_count(pixels.type);
  for (std::size_t i = 0; i < pixels.width * pixels.height; ++i)
    std::memset(pixels.bytes.data() + i * pixels.texel_bytes() + channel * bytes, 255, bytes);
  return true;
}

// The root of the mean square residual of an even grid: finding it out takes longer than to convert.
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

}  // namespace

bool is_constant(const ImagePixels& pixels) {
  const std::size_t size = pixels.texel_bytes();
  // Every byte equals the one a texel before it.
  return pixels.bytes.size() <= size ||
         std::memcmp(pixels.bytes.data(), pixels.bytes.data() + size, pixels.bytes.size() - size) == 0;
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

MetalRoughMaps projected(const SpecGlossMaps& maps, double prior, InstructionSet set) {
  const ImagePixels& color_model = maps.diffuse != nullptr ? *maps.diffuse : *maps.specgloss;
  const ImagePixels& data_model = maps.specgloss != nullptr ? *maps.specgloss : *maps.diffuse;
  const bool has_alpha = maps.diffuse != nullptr && maps.diffuse->has_alpha();
  ImagePixels base = blank_like(color_model, has_alpha ? 4 : 3), data = blank_like(data_model, 3);
  MapConversion conversion;
  conversion.width = color_model.width;
  conversion.height = color_model.height;
  conversion.sources[Parameter::kDiffuse] = color_source(maps.diffuse, maps.factors.diffuse, "diffuse");
  conversion.sources[Parameter::kSpecular] = color_source(maps.specgloss, maps.factors.specular, "specular");
  conversion.sources[Parameter::kRoughness] = glossiness_source(maps.specgloss, maps.factors.glossiness);
  conversion.source_convention = RoughnessConvention::kGlossiness;
  conversion.target_convention = RoughnessConvention::kRoughness;
  conversion.value_statistics = true;
  conversion.targets[Parameter::kBaseColor] = {
      {channel_of_pixels(base, 0), channel_of_pixels(base, 1), channel_of_pixels(base, 2)}, Transfer::kSrgb};
  conversion.targets[Parameter::kRoughness] = {{channel_of_pixels(data, 1)}, Transfer::kLinear};
  conversion.targets[Parameter::kMetallic] = {{channel_of_pixels(data, 2)}, Transfer::kLinear};
  const std::unique_ptr<Converter> converter = specgloss_projection(prior, set);
  MapStatistics statistics = convert_maps(*converter, conversion);
  if (has_alpha) copy_alpha(*maps.diffuse, base);

  MetalRoughMaps result;
  result.has_metal = statistics.targets[Parameter::kMetallic].max > 0.0f;
  result.residual = sampled_residual(*converter, std::move(conversion));
  const bool is_rough = collapse(statistics.targets[Parameter::kRoughness], data, 1, result.roughness);
  const bool is_metal = collapse(statistics.targets[Parameter::kMetallic], data, 2, result.metallic);
  if (!is_rough || !is_metal) result.metal_rough = std::move(data);
  if (maps.diffuse == nullptr || !is_diffuse(base, *maps.diffuse, maps.factors.diffuse))
    result.base_color = std::move(base);
  return result;
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
