// This file measures shipped converters, which texremap interprets as data, against the compiled headers of
// the same converters.
#include <algorithm>
#include <random>

#include "bench/bench.hpp"
#include "bench/builds.hpp"
#include "remap/shipped_converters.hpp"

namespace remap_bench {
namespace {

// Returns the instruction set of a header compiled with `flags`, or nothing for -O2, which nobody would
// compare.
std::optional<remap::InstructionSet> set_of(const std::string& flags) {
  if (flags == "o3") return remap::InstructionSet::kBaseline;
  if (flags == "avx2") return remap::InstructionSet::kAvx2;
  if (flags == "avx512") return remap::InstructionSet::kAvx512;
  return std::nullopt;
}

struct Pair {
  const remap::Converter* data;
  std::string header;  // benchmark of the compiled header
  std::string flags;
};

// Returns the headers of shipped converters among the builds, each with its converter.
std::vector<Pair> pairs() {
  std::vector<Pair> pairs;
  for (const Build<Pass>& build : pass_builds())
    if (const auto set = set_of(build.flags))
      for (const auto& converter : remap::shipped_converters(*set))
        if (converter->info().id == build.code)
          pairs.push_back({converter.get(), build.code + "_" + build.flags, build.flags});
  return pairs;
}

void convert(Maps& maps, Pass pass) {
  auto& in = maps.in;
  auto& out = maps.out;
  benchmark::DoNotOptimize(pass(maps.texels, in[0].data(), {in[1].data(), in[2].data(), in[3].data()},
                                out[0].data(), {out[1].data(), out[2].data(), out[3].data()}));
}

std::string data_name(const Pair& pair) { return "data_" + pair.header + "/small"; }

void convert(const remap::Converter& converter, Maps& maps) {
  const std::array<const float*, 3> specular = {maps.in[1].data(), maps.in[2].data(), maps.in[3].data()};
  const std::array<float*, 3> specular_out = {maps.out[1].data(), maps.out[2].data(), maps.out[3].data()};
  benchmark::DoNotOptimize(
      converter.convert(maps.texels, maps.in[0].data(), specular, maps.out[0].data(), specular_out));
}

Maps& small_maps() {
  static Maps maps(64 * 64);
  return maps;
}

}  // namespace

Maps::Maps(std::size_t count) : texels(count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> share(0.01f, 0.99f);
  for (auto& row : in) {
    row.resize(texels);
    for (float& value : row) value = &row == &in[0] ? share(random) : 0.2f * share(random);
  }
  for (auto& row : out) row.assign(texels, 1.0f);
}

void add_converters() {
  for (const Build<Pass>& build : pass_builds())
    add_benchmark(build.code + "_" + build.flags + "/small", small_maps().texels, 7,
                  [pass = build.function] { convert(small_maps(), pass); });
  for (const Pair& pair : pairs())
    add_benchmark(data_name(pair), small_maps().texels, 7,
                  [converter = pair.data] { convert(*converter, small_maps()); });
}

Section converter_section(const Medians& medians) {
  Section section{"texremap's converters as data against their compiled headers, RGB, 64 x 64, in cache", {}};
  std::map<std::string, std::vector<double>> ratios;
  for (const Pair& pair : pairs()) {
    const auto ratio = speed_ratio(medians, data_name(pair), pair.header + "/small");
    section.rows.push_back({pair.data->info().id + " at " + flags_text(pair.flags),
                            mega_items(medians, data_name(pair)), "Mtexel/s", ratio, "the header", 0.9});
    if (ratio) ratios[pair.flags].push_back(*ratio);
  }
  for (auto& [flags, values] : ratios) {
    std::sort(values.begin(), values.end());
    section.rows.push_back(
        {"median of these at " + flags_text(flags), {}, "", values[values.size() / 2], "the header", 0.9});
  }
  return section;
}

}  // namespace remap_bench
