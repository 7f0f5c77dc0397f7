// Passes of headers against a memcpy of the same four channels.
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

// The same texels interleaved: RGBA whose alpha is the width, or RGB.
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

// Whether a pass is fast enough for large maps.
bool is_lowered(const std::string& code) {
  return code == "svr" || code == "parametric" || code == "fused" || code == "mlp";
}

std::optional<double> goal(const std::string& code, const std::string& flags) {
  const bool parametric = code == "parametric";
  if (code == "fused" && flags == "avx2") return 0.5;
  if (code == "fused" || code == "mlp" || flags == "o2") return std::nullopt;
  if (flags == "o3") return parametric ? 0.5 : 0.3;
  if (flags == "avx2") return parametric ? 0.95 : 0.6;
  return parametric ? 1.0 : 0.8;
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
    if (is_lowered(build.code))
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

Section pass_section(const Medians& medians, const std::string& code, const std::string& title) {
  Section section{title + ", roughness + RGB, one core", {}};
  section.rows.push_back(pass_row(medians, "memcpy of the four channels, 4096 x 4096", "memcpy", "large"));
  section.rows.back().ratio.reset();
  for (const Build<Pass>& build : pass_builds()) {
    if (build.code != code) continue;
    const std::string name = code + "_" + build.flags;
    section.rows.push_back(
        pass_row(medians, "header at " + flags_text(build.flags) + ", 4096 x 4096", name, "large"));
    section.rows.back().goal = goal(code, build.flags);
  }
  for (const Build<Pass>& build : pass_builds())
    if (build.code == code && build.flags != "o2")
      section.rows.push_back(pass_row(medians, "header at " + flags_text(build.flags) + ", 64 x 64, in cache",
                                      code + "_" + build.flags, "small"));
  return section;
}

Section other_pass_section(const Medians& medians) {
  Section section{"Other headers of the same table, roughness + RGB, one core", {}};
  for (const Build<Pass>& build : pass_builds()) {
    const std::string name = build.code + "_" + build.flags, flags = flags_text(build.flags);
    if (build.code == "mlp")
      section.rows.push_back(
          pass_row(medians, "lowered MLP 2 x 8 at " + flags + ", 4096 x 4096", name, "large"));
  }
  return section;
}

}  // namespace remap_bench
