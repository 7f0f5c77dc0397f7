// This file measures passes of headers, over planes and over interleaved texels.
#include <cstring>
#include <memory>
#include <random>

#include "bench/bench.hpp"
#include "bench/builds.hpp"

namespace remap_bench {
namespace {

void copy(Maps& maps) {
  for (std::size_t c = 0; c < 4; ++c)
    std::memcpy(maps.out[c].data(), maps.in[c].data(), maps.texels * sizeof(float));
}

void convert(Maps& maps, Pass pass) {
  auto& in = maps.in;
  auto& out = maps.out;
  benchmark::DoNotOptimize(pass(maps.texels, in[0].data(), {in[1].data(), in[2].data(), in[3].data()},
                                out[0].data(), {out[1].data(), out[2].data(), out[3].data()}));
}

// A TexelMaps holds the texels of Maps interleaved: RGBA with the width in alpha, or RGB.
struct TexelMaps {
  explicit TexelMaps(const Maps& maps) : out(4 * maps.texels) {
    for (std::size_t i = 0; i < maps.texels; ++i) {
      for (const std::size_t c : {1u, 2u, 3u, 0u}) rgba.push_back(maps.in[c][i]);
      rgb.insert(rgb.end(), rgba.end() - 4, rgba.end() - 1);
    }
  }
  std::vector<float> rgba, rgb, out;
};

constexpr std::array<std::pair<TexelUse, const char*>, 3> kUses = {
    {{TexelUse::kRgba, "RGBA"},
     {TexelUse::kRgb, "RGB and a map of the width"},
     {TexelUse::kSingle, "RGBA by evaluate()"}}};

std::string texel_name(const Build<TexelPass>& build, const char* use, const char* maps) {
  return build.code + "_" + build.flags + "/" + use + "/" + maps;
}

void add_texels(Maps& maps, const char* size, int repetitions) {
  const auto texels = std::make_shared<TexelMaps>(maps);
  for (const Build<TexelPass>& build : texel_builds())
    for (const auto& [use, text] : kUses)
      add_benchmark(texel_name(build, text, size), maps.texels, repetitions,
                    [&maps, texels, pass = build.function, use = use] {
                      pass(use, maps.texels, maps.in[0].data(),
                           (use == TexelUse::kRgb ? texels->rgb : texels->rgba).data(), maps.out[0].data(),
                           texels->out.data());
                      benchmark::ClobberMemory();
                    });
}

}  // namespace

Row pass_row(const Medians& medians, const std::string& what, const std::string& name,
             const std::string& maps) {
  return {what,       mega_items(medians, name + "/" + maps),
          "Mtexel/s", speed_ratio(medians, name + "/" + maps, "memcpy/" + maps),
          "memcpy",   {}};
}

Maps::Maps(std::size_t count) : texels(count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> share(0.01f, 0.99f);
  for (auto& row : in) {
    row.resize(texels);
    for (float& value : row) value = &row == &in[0] ? share(random) : 0.2f * share(random);
  }
  for (auto& row : out) row.assign(texels, 1.0f);
}

Maps& large_maps() {
  static Maps maps(4096 * 4096);
  return maps;
}

Maps& small_maps() {
  static Maps maps(64 * 64);
  return maps;
}

void add_passes() {
  add_texels(large_maps(), "large", 9);
  add_texels(small_maps(), "small", 7);
  add_benchmark("memcpy/large", large_maps().texels, 15, [] { copy(large_maps()); });
  add_benchmark("memcpy/small", small_maps().texels, 15, [] { copy(small_maps()); });
  for (const Build<Pass>& build : pass_builds()) {
    const std::string name = build.code + "_" + build.flags;
    const Pass pass = build.function;
    add_benchmark(name + "/small", small_maps().texels, 7, [pass] { convert(small_maps(), pass); });
    if (build.code == kLargeHeader)
      add_benchmark(name + "/large", large_maps().texels, 15, [pass] { convert(large_maps(), pass); });
  }
}

Section texel_section(const Medians& medians) {
  Section section{"Interleaved texels against planar rows of the same header, one core", {}};
  for (const Build<TexelPass>& build : texel_builds())
    for (const auto& [use, text] : kUses)
      for (const char* size : {"large", "small"}) {
        const std::string name = texel_name(build, text, size),
                          planar = build.code + "_" + build.flags + "/" + size;
        section.rows.push_back({build.code + " at " + flags_text(build.flags) + ", " + text + ", " + size,
                                mega_items(medians, name), "Mtexel/s", speed_ratio(medians, name, planar),
                                "planar", use == TexelUse::kSingle ? std::nullopt : std::optional(0.8)});
      }
  return section;
}

}  // namespace remap_bench
