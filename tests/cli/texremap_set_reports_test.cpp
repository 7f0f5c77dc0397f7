// This file tests sets that users reported, each with the correct result.
#include <catch2/catch.hpp>

#include "cli/texremap_tree.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

// A ReportedSets is a folder of sets for one report.
class ReportedSets : public Tree {
 public:
  // Writes a map of one color.
  void plain(const std::string& name, const std::vector<int>& values, int size = 16) const {
    drawn(
        name, values.size(), [&](int, int, int c) { return values[static_cast<std::size_t>(c)]; }, size);
  }
  // Writes an 8-bit map. `steps` returns the integers of its texels.
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
  // Returns the first texel, in steps of 8 bits.
  std::vector<int> texel(const std::string& name) const {
    const TestImage found = image(name);
    return {found.bytes.begin(), found.bytes.begin() + found.spec.nchannels};
  }
};

}  // namespace

TEST_CASE("reports: 13 rough_ao of Poly Haven", "[reports][slow]") {
  const ReportedSets sets;
  sets.plain("in/textures/old_bench_diff_1k.jpg", {120, 80, 40});
  sets.plain("in/textures/old_bench_nor_1k.jpg", {128, 128, 255});
  sets.plain("in/textures/old_bench_rough_ao_1k.png", {200, 180, 0});
  const std::string packed = "out/textures/old_bench_occlusionRoughnessMetallic.png";
  SECTION("alone") {
    require_success(
        sets.texremap("convert in -r --from polyhaven --to gltf --layout gltf --metallic 0 -o out"));
    CHECK(sets.texel(packed) == std::vector{180, 200, 0});
  }
  SECTION("beside arm, which contains more of the material") {
    sets.plain("in/textures/old_bench_arm_1k.png", {190, 210, 255});
    const ProcessResult result =
        require_success(sets.texremap("convert in -r --from polyhaven --to gltf --layout gltf -o out"));
    CHECK(sets.texel(packed) == std::vector{190, 210, 255});
    CHECK_THAT(result.errors, Contains("roughness is read from old_bench_arm_1k.png:G"));
  }
}

TEST_CASE("reports: 19 a nearly grey roughness map", "[reports][slow]") {
  const ReportedSets sets;
  const int tint = GENERATE(5, 18);
  const std::string extension = GENERATE("png", "jpg"), map = "in/sand_rough." + extension;
  sets.plain("in/sand_albedo.png", {120, 80, 40}, 32);
  sets.drawn(
      map, 3, [&](int x, int, int c) { return 100 + (c == 0 && x >= 16 ? tint : 0); }, 32);
  const Words words = "convert in --from metal-rough --to gltf --layout gltf --metallic 0 -o out";
  const ProcessResult result = require_success(sets.texremap(words));
  CHECK_THAT(result.errors,
             Contains("warning: " + map +
                      ": is not exactly grey: the channels differ from G, which is used, by at most "));
  if (extension == "png")
    CHECK_THAT(result.errors, Contains("by at most " + std::to_string(tint) + " of 255"));
  CHECK(std::abs(sets.texel("out/sand_occlusionRoughnessMetallic.png")[1] - 100) <=
        (extension == "png" ? 0 : 3));

  // A map with different colors is refused, and the message proposes an option that works.
  sets.drawn(
      map, 3, [](int x, int, int c) { return 100 + (c == 0 ? 4 * x : 0); }, 32);
  const ProcessResult refused = sets.texremap(words + "--force");
  CHECK(refused.exit_code == 1);
  CHECK_THAT(refused.errors, Contains("(choose one channel: --roughness '*_rough." + extension + ":G')"));
  require_success(sets.texremap(words + ("--force --roughness *_rough." + extension + ":R")));
}

TEST_CASE("reports: one map for several sets of a folder", "[reports][slow]") {
  const ReportedSets sets;
  for (const std::string name : {"black", "white"}) {
    sets.plain("in/king_" + name + "_roughness.png", {90});
    sets.plain("in/king_" + name + "_baseColor.png", {120, 80, 40});
  }
  sets.plain("in/king_shared_metallic.png", {255});
  const ProcessResult result = require_success(sets.texremap(
      "convert in --from metallic --to gltf --layout gltf --metallic in/king_shared_metallic.png -o out"));
  CHECK_THAT(result.errors, Contains("note: in/king_shared_metallic.png is used for all sets"));
  for (const std::string name : {"black", "white"})
    CHECK(sets.texel("out/king_" + name + "_occlusionRoughnessMetallic.png") == std::vector{255, 90, 255});
  // A name without * is also searched in the folder of each set's maps.
  require_success(
      sets.texremap("convert in --from metallic --to gltf --metallic king_shared_metallic.png -o two"));
  CHECK(sets.texremap("convert in --from metallic --to gltf --metallic nothing.png -o three").exit_code == 1);
}

namespace {

// A Green is the direction of green that an engine reads: up, down, or as in the input.
enum class Green { kUp, kDown, kKept };
constexpr std::array<std::pair<const char*, Green>, 9> kEngines = {{{"gltf", Green::kUp},
                                                                    {"unity", Green::kUp},
                                                                    {"unity-hdrp", Green::kUp},
                                                                    {"unreal", Green::kDown},
                                                                    {"godot", Green::kUp},
                                                                    {"threejs", Green::kUp},
                                                                    {"blender", Green::kUp},
                                                                    {"usd", Green::kUp},
                                                                    {"marmoset", Green::kKept}}};

void write_rock(const ReportedSets& sets, const std::string& normal) {
  sets.plain("in/T_Rock_BC.png", {120, 80, 40});
  sets.plain("in/T_Rock_ORM.png", {255, 90, 0});
  sets.plain("in/" + normal, {128, 100, 255});
}

// `--to gltf` only chooses the material, so the layout must be given.
Words words_to(const std::string& engine) {
  return "--to " + engine + (engine == "gltf" ? " --layout gltf" : "");
}

}  // namespace

TEST_CASE("reports: 07 green of normal maps between all engines", "[reports][slow]") {
  const ReportedSets sets;
  write_rock(sets, "T_Rock_N.png");
  for (const auto& [from, written] : kEngines)
    for (const auto& [to, read] : kEngines) {
      INFO(from << " to " << to);
      const ProcessResult result =
          require_success(sets.texremap(Words("convert in --force -o out --from") + from + words_to(to)));
      const bool is_known = written != Green::kKept && read != Green::kKept;
      const bool is_inverted = is_known && written != read;
      CHECK(sets.texel("out/T_Rock_N.png") == std::vector{128, is_inverted ? 155 : 100, 255});
      const std::string line = "note: in/T_Rock_N.png: green is ";
      if (is_inverted)
        CHECK_THAT(result.errors,
                   Contains(line + "inverted in the copy T_Rock_N.png, because --from " + from));
      else if (is_known)
        CHECK_THAT(result.errors, !Contains(line));
      else
        CHECK_THAT(result.errors, Contains(line + "kept, because "));
    }
}

TEST_CASE("reports: 07 the name of a normal map wins over --from", "[reports][slow]") {
  const ReportedSets sets;
  const auto green = [&](const std::string& words, const std::string& name) {
    std::filesystem::remove_all(sets.path("out"));
    require_success(sets.texremap(Words("convert in -o out") + Words(words)));
    return sets.texel("out/" + name)[1];
  };
  SECTION("OpenGL") {
    write_rock(sets, "T_Rock_NormalGL.png");
    CHECK(green("--from unreal --to gltf --layout gltf", "T_Rock_NormalGL.png") == 100);
    CHECK(green("--from gltf --to unreal", "T_Rock_NormalDX.png") == 155);
    CHECK(green("--from metal-rough --to ue5", "T_Rock_NormalDX.png") == 155);
  }
  SECTION("DirectX") {
    write_rock(sets, "T_Rock_nor_dx.png");
    CHECK(green("--from gltf --to unreal", "T_Rock_nor_dx.png") == 100);
    CHECK(green("--from gltf --to blender", "T_Rock_nor_gl.png") == 155);
  }
  SECTION("neither the name nor the source says it") {
    write_rock(sets, "T_Rock_N.png");
    CHECK(green("--from metal-rough --to unity", "T_Rock_N.png") == 100);
    CHECK_THAT(sets.texremap("convert in --from substance --to unity -o two").errors,
               Contains("in/T_Rock_N.png: green is kept, because neither the file name nor --from shows "
                        "whether the map is OpenGL or DirectX; unity reads OpenGL (green up)"));
  }
}

TEST_CASE("reports: a set for an engine is complete, by --to as by --layout", "[reports][slow]") {
  const ReportedSets sets;
  write_rock(sets, "T_Rock_N.png");
  sets.plain("in/T_Rock_Height.png", {70});
  sets.plain("in/T_Rock_Emissive.png", {1, 2, 3});
  sets.plain("in/T_Rock_Opacity.png", {40});
  const std::vector<std::string> others = {"T_Rock_Emissive.png", "T_Rock_Height.png", "T_Rock_N.png",
                                           "T_Rock_Opacity.png"};
  std::vector<std::string> made = {"T_Rock_BaseMap.png", "T_Rock_MetallicSmoothness.png",
                                   "T_Rock_Occlusion.png"};
  std::vector<std::string> all = made;
  all.insert(all.end(), others.begin(), others.end());
  std::sort(all.begin(), all.end());
  const std::string words = GENERATE("--to unity", "--from gltf --to gltf --layout unity");
  require_success(sets.texremap("convert in -o out " + words));
  CHECK(sets.results() == all);
  CHECK(sets.texel("out/T_Rock_MetallicSmoothness.png") == std::vector{0, 0, 0, 165});
  std::filesystem::remove_all(sets.path("out"));
  require_success(sets.texremap("convert in --only-converted -o out " + words));
  CHECK(sets.results() == made);
}

TEST_CASE("reports: what a packed map holds besides comes along as a map", "[reports][slow]") {
  const ReportedSets sets;
  sets.plain("in/T_Rock_BC.png", {120, 80, 40});
  sets.plain("in/T_Rock_ORDp.png", {250, 90, 33});
  require_success(sets.texremap("convert in --from unreal --to unity --metallic 0 -o out"));
  CHECK(sets.texel("out/T_Rock_height.png") == std::vector{33});
  CHECK(sets.texel("out/T_Rock_Occlusion.png") == std::vector{250});
}

TEST_CASE("reports: a folder prints one line a set where nothing is visible", "[reports][slow]") {
  const ReportedSets sets;
  constexpr std::size_t kSets = 12;
  for (std::size_t i = 0; i < kSets; ++i) {
    const std::string name = "in/rock" + std::to_string(i) + "x_";
    sets.plain(name + "diffuse.png", {120, 80, 40}, 8);
    sets.plain(name + "specular.png", {56, 56, 56}, 8);
    sets.plain(name + "glossiness.png", {200}, 8);
    sets.plain(name + "normal.png", {128, 128, 255}, 8);
  }
  const auto lines = [](const std::string& text) {
    return static_cast<std::size_t>(std::ranges::count(text, '\n'));
  };
  const Words words = "convert in --from gltf-specgloss --to unreal --force -o out";
  const std::string brief = require_success(sets.texremap(words)).errors;
  CHECK(lines(brief) <= kSets + 16);
  CHECK_THAT(brief, !Contains("undetermined") && Contains("of the same kinds (--verbose lists them)"));
  const std::string verbose = require_success(sets.texremap(words + "--verbose")).errors;
  CHECK(lines(verbose) >= 4 * kSets);
  CHECK_THAT(verbose, Contains("metallic is undetermined, without visible effect"));
  // Metal-rough cannot express a blue metal with red diffuse.
  sets.plain("in/rock0x_specular.png", {20, 20, 230}, 8);
  sets.plain("in/rock0x_diffuse.png", {230, 20, 20}, 8);
  CHECK_THAT(
      require_success(sets.texremap(words)).errors,
      Contains("in/rock0x: metal-rough cannot express these maps exactly; the visible difference is about"));
}
