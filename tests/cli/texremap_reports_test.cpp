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
