// map_speed [INSTRUCTIONS] prints the speed of five converters over maps of floats in memory on one thread,
// and a checksum of the results: `SOURCE TARGET MTEXEL/S CHECKSUM`. packages/npm/bench.mjs compares the
// package for node with it.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <limits>
#include <string>
#include <vector>

#include "remap/convert_maps.hpp"
#include "remap/error.hpp"
#include "remap/path.hpp"

using namespace remap;

namespace {

constexpr std::size_t kWidth = 2048, kHeight = 2048, kPasses = 5;

// Returns the values that bench.mjs uses: a Weyl sequence of 24 bits.
float value_at(std::size_t i) {
  return static_cast<float>((static_cast<std::uint32_t>(i) * 0x9e3779b1u) >> 8) * 0x1p-24f;
}

struct Made {
  double seconds = std::numeric_limits<double>::infinity();  // time of the fastest pass
  std::uint32_t checksum = 0;
};

Made convert(const Converter& converter) {
  constexpr std::size_t kCount = kWidth * kHeight;
  std::vector<float> roughness(kCount), specular(3 * kCount), roughness_out(kCount), specular_out(3 * kCount);
  for (std::size_t i = 0; i < roughness.size(); ++i) roughness[i] = value_at(i);
  for (std::size_t i = 0; i < specular.size(); ++i) specular[i] = value_at(i);
  MapConversion maps;
  maps.width = kWidth;
  maps.height = kHeight;
  maps.sources[Parameter::kRoughness].channels = {float_channel<const float>(roughness.data(), kWidth)};
  maps.targets[Parameter::kRoughness].channels = {float_channel(roughness_out.data(), kWidth)};
  for (std::size_t c = 0; c < 3; ++c) {
    maps.sources[Parameter::kSpecular].channels.push_back(
        float_channel<const float>(specular.data() + c, kWidth, 3));
    maps.targets[Parameter::kSpecular].channels.push_back(float_channel(specular_out.data() + c, kWidth, 3));
  }
  Made made;
  for (std::size_t pass = 0; pass < kPasses; ++pass) {
    const std::clock_t start = std::clock();  // processor time
    convert_maps(converter, maps);
    made.seconds = std::min(made.seconds, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  for (const auto* row : {&roughness_out, &specular_out})
    for (const float value : *row)
      made.checksum = made.checksum * 31 + __builtin_bit_cast(std::uint32_t, value);
  return made;
}

void print(const ConverterGraph& graph, const std::string& source, const std::string& target) {
  const ConverterPath path = graph.find_paths({source, target, {}}).front();
  const auto chain = make_chained_converter(path.steps);
  const Made made = convert(path.steps.size() > 1 ? *chain : *path.steps.front());
  std::printf("%s %s %.1f %08x\n", source.c_str(), target.c_str(), kWidth * kHeight / made.seconds * 1e-6,
              static_cast<unsigned>(made.checksum));
}

}  // namespace

int main(int argc, char** argv) try {
  const ConverterGraph graph =
      shipped_graph(argc > 1 ? instruction_set_from_name("INSTRUCTIONS", argv[1]) : best_instruction_set());
  for (const char* target : {"mitsuba/as", "mitsuba/ggx", "cycles-5/ggx", "threejs-r187/standard-metal"})
    print(graph, "mitsuba/ward", target);
  print(graph, "mitsuba/phong", "mitsuba/ggx");
  return 0;
} catch (const Error& error) {
  std::fprintf(stderr, "map_speed: %s\n", error.what());
  return 1;
}
