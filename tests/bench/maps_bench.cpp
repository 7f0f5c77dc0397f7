// This file measures convert_maps() on one core: loading, the search for invalid values, conversion, storing.
// Its rival is only the converter, over rows of the same length.
#include <cstdint>
#include <memory>
#include <random>
#include <stdexcept>

#include "bench/bench.hpp"
#include "remap/convert_maps.hpp"
#include "remap/shipped_converters.hpp"

namespace remap_bench {
namespace {

constexpr std::size_t kSide = 4096;

const remap::Converter& ward_to_as() {
  for (const auto& converter : remap::shipped_converters())
    if (converter->info().id == "mitsuba_ward_to_mitsuba_as") return *converter;
  throw std::logic_error("no converter mitsuba_ward_to_mitsuba_as");
}

Maps& large_maps() {
  static Maps maps(kSide * kSide);
  return maps;
}

// Describes width and RGB in four planes of floats.
remap::MapConversion planes(Maps& maps) {
  remap::MapConversion conversion;
  for (std::size_t c = 0; c < 4; ++c) {
    const auto parameter = c == 0 ? remap::Parameter::kRoughness : remap::Parameter::kSpecular;
    conversion.sources[parameter].channels.push_back(remap::float_channel(maps.in[c].data(), kSide));
    conversion.targets[parameter].channels.push_back(remap::float_channel(maps.out[c].data(), kSide));
  }
  return conversion;
}

// Describes RGB with the width in alpha.
remap::MapConversion interleaved(std::byte* in, std::byte* out, remap::PixelType type,
                                 remap::Transfer transfer) {
  const auto texel = static_cast<std::ptrdiff_t>(4 * remap::byte_count(type));
  remap::MapConversion conversion;
  for (std::size_t c = 0; c < 4; ++c) {
    const auto parameter = c == 3 ? remap::Parameter::kRoughness : remap::Parameter::kSpecular;
    const std::size_t place = c * remap::byte_count(type);
    const auto row = texel * static_cast<std::ptrdiff_t>(kSide);
    conversion.sources[parameter].channels.push_back(remap::ChannelView{in + place, type, texel, row});
    conversion.targets[parameter].channels.push_back(remap::ChannelView{out + place, type, texel, row});
  }
  conversion.sources[remap::Parameter::kSpecular].transfer = transfer;
  conversion.targets[remap::Parameter::kSpecular].transfer = transfer;
  return conversion;
}

void add_maps_benchmark(const std::string& name, const std::function<remap::MapConversion()>& make) {
  add_benchmark("maps/" + name, kSide * kSide, 7,
                [conversion = std::shared_ptr<remap::MapConversion>(), make]() mutable {
                  if (!conversion) conversion = std::make_shared<remap::MapConversion>(make());
                  conversion->width = conversion->height = kSide;
                  benchmark::DoNotOptimize(remap::convert_maps(ward_to_as(), *conversion, 1));
                });
}

// Returns bytes of all values, evenly distributed.
std::vector<std::byte>& random_bytes() {
  static std::vector<std::byte> bytes = [] {
    std::mt19937 random(1);
    std::vector<std::byte> values(4 * kSide * kSide);
    for (std::byte& value : values) value = static_cast<std::byte>(random() & 0xffu);
    return values;
  }();
  return bytes;
}

std::vector<std::byte>& room() {
  static std::vector<std::byte> bytes(4 * sizeof(float) * kSide * kSide);
  return bytes;
}

std::vector<float>& interleaved_floats() {
  static std::vector<float> values = [] {
    std::vector<float> made;
    for (std::size_t i = 0; i < kSide * kSide; ++i)
      for (const std::size_t c : {1u, 2u, 3u, 0u}) made.push_back(large_maps().in[c][i]);
    return made;
  }();
  return values;
}

}  // namespace

void add_maps() {
  add_benchmark("maps/converter", kSide * kSide, 7, [] {
    Maps& maps = large_maps();
    for (std::size_t first = 0; first < maps.texels; first += kSide) {
      const std::array<const float*, 3> specular = {maps.in[1].data() + first, maps.in[2].data() + first,
                                                    maps.in[3].data() + first};
      const std::array<float*, 3> specular_out = {maps.out[1].data() + first, maps.out[2].data() + first,
                                                  maps.out[3].data() + first};
      benchmark::DoNotOptimize(ward_to_as().convert(kSide, maps.in[0].data() + first, specular,
                                                    maps.out[0].data() + first, specular_out));
    }
  });
  add_maps_benchmark("planes", [] { return planes(large_maps()); });
  add_maps_benchmark("interleaved", [] {
    return interleaved(reinterpret_cast<std::byte*>(interleaved_floats().data()), room().data(),
                       remap::PixelType::kFloat, remap::Transfer::kLinear);
  });
  add_maps_benchmark("srgb", [] {
    return interleaved(random_bytes().data(), room().data(), remap::PixelType::kUint8,
                       remap::Transfer::kSrgb);
  });
}

Section maps_section(const Medians& medians) {
  Section section{"convert_maps, Ward to Ashikhmin-Shirley, 4096 x 4096, roughness + RGB, one core", {}};
  const auto add = [&](const std::string& what, const std::string& name) -> Row& {
    section.rows.push_back({what, mega_items(medians, "maps/" + name), "Mtexel/s",
                            speed_ratio(medians, "maps/" + name, "maps/converter"), "the converter alone"});
    return section.rows.back();
  };
  add("the converter alone, row by row", "converter").ratio.reset();
  add("planes of floats", "planes").goal = 0.8;
  add("interleaved floats", "interleaved").goal = 0.8;
  add("8-bit sRGB with the width in alpha", "srgb");
  return section;
}

}  // namespace remap_bench
