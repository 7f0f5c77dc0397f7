// This file measures appearance warps: the fit from two texture sets and strokes, and the pass of the
// compiled table.
#include "bench/bench.hpp"
#include "stages/kernels.hpp"
#include "support/warp_sets.hpp"
#include "warp/warp.hpp"

namespace remap_bench {
namespace {

constexpr std::size_t kSize = 512;
constexpr std::size_t kTexels = kSize * kSize;

// A WarpCase holds a set with a known answer, its warp, and its source as rows.
struct WarpCase {
  explicit WarpCase(remap::WarpSet made)
      : set(std::move(made)), strokes(remap::strokes_of(set, 0)), packed(remap::packed(fit().compiled)) {
    for (std::size_t r = 0; r < in.size(); ++r) {
      in[r].resize(kTexels);
      out[r].resize(kTexels);
      for (std::size_t i = 0; i < kTexels; ++i) in[r][i] = set.source.texels[i][r];
    }
  }
  remap::WarpFit fit() const { return fit_warp(set.source, set.target, strokes); }

  remap::WarpSet set;
  std::vector<remap::StrokePair> strokes;
  remap::PackedWarp packed;
  std::array<std::vector<float>, remap::kWarpParameters> in, out;
};

// leaf() has two latent parameters, the next one three.
WarpCase& leaf() {
  static WarpCase made(remap::leaf_set(kSize));
  return made;
}
WarpCase& rust() {
  static WarpCase made(remap::rust_set(kSize));
  return made;
}

void run_pass(remap::InstructionSet set, WarpCase& warp) {
  std::array<const float*, remap::kWarpParameters> in{};
  std::array<float*, remap::kWarpParameters> out{};
  for (std::size_t r = 0; r < in.size(); ++r) {
    in[r] = warp.in[r].data();
    out[r] = warp.out[r].data();
  }
  benchmark::DoNotOptimize(kernels(set).warp(warp.packed, kTexels, in, out));
}

struct Case {
  const char* name;
  const char* what;
  WarpCase& (*get)();
  double seconds_goal;
};
constexpr Case kCases[] = {{"leaf", "2 dimensions", leaf, 0.1}, {"rust", "3 dimensions", rust, 0.15}};

std::vector<remap::InstructionSet> available_sets() {
  std::vector<remap::InstructionSet> sets;
  for (const auto set :
       {remap::InstructionSet::kBaseline, remap::InstructionSet::kAvx2, remap::InstructionSet::kAvx512})
    if (set <= remap::best_instruction_set()) sets.push_back(set);
  return sets;
}

std::string pass_name(const Case& one, remap::InstructionSet set) {
  return "warp/" + std::string(one.name) + "/" + std::string(instruction_set_name(set));
}

std::optional<double> speed_goal(remap::InstructionSet set) {
  if (set == remap::InstructionSet::kAvx512) return std::nullopt;
  return set == remap::InstructionSet::kAvx2 ? 60.0 : 25.0;
}

}  // namespace

void add_warps() {
  for (const Case& one : kCases) {
    add_benchmark("warp/" + std::string(one.name) + "/fit", 1, 7,
                  [&one] { benchmark::DoNotOptimize(one.get().fit()); });
    for (const remap::InstructionSet set : available_sets())
      add_benchmark(pass_name(one, set), kTexels, 15, [&one, set] { run_pass(set, one.get()); });
  }
}

Section warp_section(const Medians& medians) {
  Section section{"Appearance warps, 512 x 512, one core", {}};
  for (const Case& one : kCases) {
    const std::string what = one.what;
    section.rows.push_back({"strokes to the compiled table, " + what,
                            medians.seconds("warp/" + std::string(one.name) + "/fit"),
                            "s",
                            {},
                            "",
                            one.seconds_goal,
                            false});
    for (const remap::InstructionSet set : available_sets())
      section.rows.push_back({"pass, " + what + ", " + std::string(instruction_set_name(set)),
                              mega_items(medians, pass_name(one, set)),
                              "Mtexel/s",
                              {},
                              "",
                              speed_goal(set),
                              false});
  }
  return section;
}

}  // namespace remap_bench
