// What users reported, each with the result that is right.
#include <catch2/catch.hpp>

#include "cli/texremap_tree.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

// A folder of sets for one report.
class ReportedSets : public Tree {
 public:
  // A map of one color.
  void plain(const std::string& name, const std::vector<int>& values, int size = 16) const {
    drawn(
        name, values.size(), [&](int, int, int c) { return values[static_cast<std::size_t>(c)]; }, size);
  }
  // A map of 8 bits, by its steps.
  template <typename Steps>
  void drawn(const std::string& name, std::size_t channels, const Steps& steps, int size = 16) const {
    std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
    static const std::vector<std::string> kNames = {"R", "G", "B", "A"};
    make(name,
         test_spec(size, size,
                   channels == 1
                       ? kGrey
                       : std::vector(kNames.begin(), kNames.begin() + static_cast<std::ptrdiff_t>(channels)),
                   OIIO::TypeUInt8),
         [&](int x, int y, int c) { return static_cast<float>(steps(x, y, c)) / 255.0f; });
  }
  // The first texel, in steps of 8 bits.
  std::vector<int> texel(const std::string& name) const {
    const TestImage found = image(name);
    return {found.bytes.begin(), found.bytes.begin() + found.spec.nchannels};
  }
};

}  // namespace

TEST_CASE("reports: 13 rough_ao of Poly Haven", "[reports]") {
  const ReportedSets sets;
  sets.plain("in/textures/old_bench_diff_1k.jpg", {120, 80, 40});
  sets.plain("in/textures/old_bench_nor_1k.jpg", {128, 128, 255});
  sets.plain("in/textures/old_bench_rough_ao_1k.png", {200, 180, 0});
  const std::string packed = "out/textures/old_bench_occlusionRoughnessMetallic.png";
  SECTION("alone") {
    require_success(sets.texremap("convert in -r --from polyhaven --preset gltf --metallic 0 -o out"));
    CHECK(sets.texel(packed) == std::vector{180, 200, 0});
  }
  SECTION("beside arm, which holds more of the material") {
    sets.plain("in/textures/old_bench_arm_1k.png", {190, 210, 255});
    const ProcessResult result =
        require_success(sets.texremap("convert in -r --from polyhaven --preset gltf -o out"));
    CHECK(sets.texel(packed) == std::vector{190, 210, 255});
    CHECK_THAT(result.errors, Contains("roughness is read from old_bench_arm_1k.png:G"));
  }
}

TEST_CASE("reports: 19 a nearly grey roughness map", "[reports]") {
  const ReportedSets sets;
  const int tint = GENERATE(5, 18);
  const std::string extension = GENERATE("png", "jpg"), map = "in/sand_rough." + extension;
  sets.plain("in/sand_albedo.png", {120, 80, 40}, 32);
  sets.drawn(
      map, 3, [&](int x, int, int c) { return 100 + (c == 0 && x >= 16 ? tint : 0); }, 32);
  const Words words = "convert in --from metal-rough --preset gltf --metallic 0 -o out";
  const ProcessResult result = require_success(sets.texremap(words));
  CHECK_THAT(result.errors,
             Contains("warning: " + map + ": is not quite grey: its channels differ by at most "));
  if (extension == "png")
    CHECK_THAT(result.errors, Contains(std::to_string(tint) + " of 255, and G is used"));
  CHECK(std::abs(sets.texel("out/sand_occlusionRoughnessMetallic.png")[1] - 100) <=
        (extension == "png" ? 0 : 3));

  // A map with colors is refused, with an option that works.
  sets.drawn(
      map, 3, [](int x, int, int c) { return 100 + (c == 0 ? 4 * x : 0); }, 32);
  const ProcessResult refused = sets.texremap(words + "--force");
  CHECK(refused.exit_code == 1);
  CHECK_THAT(refused.errors, Contains("(choose one channel: --roughness '*_rough." + extension + ":G')"));
  require_success(sets.texremap(words + ("--force --roughness *_rough." + extension + ":R")));
}

TEST_CASE("reports: one map for several sets of a folder", "[reports]") {
  const ReportedSets sets;
  for (const std::string name : {"black", "white"}) {
    sets.plain("in/king_" + name + "_roughness.png", {90});
    sets.plain("in/king_" + name + "_baseColor.png", {120, 80, 40});
  }
  sets.plain("in/king_shared_metallic.png", {255});
  const ProcessResult result = require_success(sets.texremap(
      "convert in --from metallic --preset gltf --metallic in/king_shared_metallic.png -o out"));
  CHECK_THAT(result.errors, Contains("note: in/king_shared_metallic.png is used for every set"));
  for (const std::string name : {"black", "white"})
    CHECK(sets.texel("out/king_" + name + "_occlusionRoughnessMetallic.png") == std::vector{255, 90, 255});
  // A name without * is also looked up beside the maps of each set.
  require_success(sets.texremap(
      "convert in --from metallic --to gltf --metallic king_shared_metallic.png --allow-skips -o two"));
  CHECK(sets.texremap("convert in --from metallic --to gltf --metallic nothing.png -o three").exit_code == 1);
}
