// This program converts maps in memory, as an asset pipeline would, without files or an image library. The
// 8-bit RGBA buffer holds specular (sRGB), and glossiness in its alpha channel. It is converted in place.
#include <cstdint>
#include <cstdio>
#include <remap/convert_maps.hpp>
#include <remap/error.hpp>
#include <remap/path.hpp>
#include <string>
#include <vector>

int main() try {
  constexpr std::size_t kWidth = 256, kHeight = 256;
  std::vector<std::uint8_t> texels(kWidth * kHeight * 4);
  for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<std::uint8_t>(i * 7 / 256);

  // Finds the path of least expected error between the two models, as texremap does.
  const remap::ConverterPath path =
      remap::shipped_graph().find_paths({"mitsuba/ward", "cycles-2.7/ggx", {}}).front();
  const auto converter = remap::make_chained_converter(path.steps);

  const auto channel = [&](std::size_t c) {
    return remap::ChannelView{reinterpret_cast<std::byte*>(texels.data() + c), remap::PixelType::kUint8, 4,
                              static_cast<std::ptrdiff_t>(4 * kWidth)};
  };
  remap::MapConversion maps;
  maps.width = kWidth;
  maps.height = kHeight;
  for (std::size_t c = 0; c < 3; ++c) {
    maps.sources[remap::Parameter::kSpecular].channels.push_back(channel(c));
    maps.targets[remap::Parameter::kSpecular].channels.push_back(channel(c));
  }
  maps.sources[remap::Parameter::kSpecular].transfer = maps.targets[remap::Parameter::kSpecular].transfer =
      remap::Transfer::kSrgb;
  maps.sources[remap::Parameter::kRoughness].channels = {channel(3)};
  maps.targets[remap::Parameter::kRoughness].channels = {channel(3)};
  maps.source_convention = maps.target_convention = remap::RoughnessEncoding::kGlossiness;

  maps.value_statistics = true;

  const remap::MapStatistics done = remap::convert_maps(*converter, maps, 2);
  std::printf("%zu texels, %zu out of domain, specular %.3f to %.3f\n", done.texel_count,
              done.out_of_domain_count, static_cast<double>(done.targets.at(remap::Parameter::kSpecular).min),
              static_cast<double>(done.targets.at(remap::Parameter::kSpecular).max));
  return 0;
} catch (const remap::Error& error) {
  std::fprintf(stderr, "convert_buffers: %s\n", error.what());
  return 1;
}
