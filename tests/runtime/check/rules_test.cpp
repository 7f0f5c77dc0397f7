// This file tests the rules of `texremap check` on artificial texels. tests/oracles/check_judge.py tests them
// on files from bug reports.
#include "check/rules.hpp"

#include <cmath>
#include <fstream>
#include <numbers>

#include <catch2/catch.hpp>

#include "support/temporary_folder.hpp"

using namespace remap;

namespace {

constexpr int kSide = 64;

using Value = double (*)(double x, double y);

// Returns a map of `channels`, functions of x and y from 0 to 1, in 8 bits.
MaterialMap map_of(const std::string& name, const std::vector<Value>& channels) {
  TexelSample sample;
  sample.columns = sample.rows = sample.layout.width = sample.layout.height = kSide;
  const char* const names[] = {"R", "G", "B", "A"};
  for (std::size_t c = 0; c < channels.size(); ++c) {
    sample.layout.channels.push_back({names[c], PixelType::kUint8, c});
    sample.channels.emplace_back();
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x)
        sample.channels.back().push_back(
            static_cast<float>(std::lround(255.0 * channels[c]((x + 0.5) / kSide, (y + 0.5) / kSide))) /
            255.0f);
  }
  sample.layout.alpha_channel = channels.size() == 4 ? 3 : -1;
  return {name, name, name, std::make_shared<const TexelSample>(std::move(sample))};
}

CheckedMaterial set_of(const std::vector<std::pair<MaterialMap, std::vector<MaterialUse>>>& maps) {
  CheckedMaterial material;
  material.path = "set";
  for (const auto& [map, uses] : maps) {
    for (MaterialUse use : uses) {
      use.map = material.maps.size();
      material.uses.push_back(use);
    }
    material.maps.push_back(map);
  }
  return material;
}

MaterialUse use_of(Role role, Channels channels = Channels::kWhole) {
  return {role, 0, channels, "", {}, "", false};
}

std::vector<std::string> found(const CheckedMaterial& material, const GltfConsumer* reader = nullptr) {
  std::vector<std::string> names;
  for (const MaterialFinding& finding : findings_in(material, reader)) names.emplace_back(finding.rule);
  return names;
}

using Names = std::vector<std::string>;

double rough(double x, double y) { return 0.4 + 0.3 * std::sin(9.0 * x) * std::cos(7.0 * y); }

// These normals belong to the height h = 0.05 sin(a x + b y + c x y), by its derivatives. Green points up,
// while rows go down.
constexpr double kA = 14.0, kB = 9.0, kC = 11.0, kHeight = 0.05;
double slope_x(double x, double y) {
  return kHeight * (kA + kC * y) * std::cos(kA * x + kB * y + kC * x * y);
}
double slope_y(double x, double y) {
  return kHeight * (kB + kC * x) * std::cos(kA * x + kB * y + kC * x * y);
}
double length(double x, double y) { return std::hypot(1.0, slope_x(x, y), slope_y(x, y)); }
double red(double x, double y) { return 0.5 - 0.5 * slope_x(x, y) / length(x, y); }
double green_up(double x, double y) { return 0.5 + 0.5 * slope_y(x, y) / length(x, y); }
double green_down(double x, double y) { return 1.0 - green_up(x, y); }
double blue(double x, double y) { return 0.5 + 0.5 / length(x, y); }

}  // namespace

TEST_CASE("rules: a map of roughness against the gloss map of its set") {
  const MaterialMap roughness = map_of("a_Roughness.png", {rough});
  const auto with_gloss = [&](Value gloss) {
    return found(set_of({{roughness, {use_of(Role::kRoughness)}},
                         {map_of("a_Gloss.png", {gloss}), {use_of(Role::kGlossiness)}}}));
  };
  CHECK(with_gloss([](double x, double y) { return 1.0 - rough(x, y); }) == Names{});
  CHECK(with_gloss(rough) == Names{"gloss-as-roughness"});
  CHECK(with_gloss([](double x, double y) { return 1.0 - std::sqrt(rough(x, y)); }) ==
        Names{"alpha-as-roughness"});
  CHECK(with_gloss([](double x, double y) { return 1.0 - std::pow(rough(x, y), 0.25); }) ==
        Names{"alpha-as-roughness"});
}

TEST_CASE("rules: the curl of slopes tells which way green points") {
  const auto normals = [](const std::string& name, Value green) {
    return found(set_of({{map_of(name, {red, green, blue}), {use_of(Role::kNormal)}}}));
  };
  CHECK(normals("a_NormalGL.png", green_up) == Names{});
  CHECK(normals("a_NormalDX.png", green_down) == Names{});
  CHECK(normals("a_NormalGL.png", green_down) == Names{"normal-orientation"});
  CHECK(normals("a_NormalDX.png", green_up) == Names{"normal-orientation"});
  CHECK(normals("a_Normal.png", green_down) == Names{});  // the name does not state a direction
  CHECK(found(set_of({{map_of("a_Normal.png", {red, green_up, blue}), {use_of(Role::kNormal)}}}),
              &gltf_consumers()[2]) == Names{"normal-orientation"});
}

TEST_CASE("rules: greys of metallic count over areas, not at edges") {
  const auto metallic = [](Value value) {
    return found(set_of({{map_of("a_Metallic.png", {value}), {use_of(Role::kMetallic)}}}));
  };
  CHECK(metallic([](double x, double) { return x < 0.5 ? 0.0 : 1.0; }) == Names{});
  CHECK(metallic([](double x, double) {
          return std::fabs(x - 0.5) < 0.03 ? 0.5 : x < 0.5 ? 0.0 : 1.0;
        }) == Names{});
  CHECK(metallic([](double x, double) {
          return std::fabs(x - 0.5) < 0.2 ? 0.5 : x < 0.5 ? 0.0 : 1.0;
        }) == Names{"metallic-greys"});
}

TEST_CASE("rules: a specular color in another color space, and none at all") {
  const auto specular = [](Value value, const std::vector<MaterialUse>& others = {}) {
    std::vector<MaterialUse> uses = others;
    uses.push_back(use_of(Role::kSpecular));
    return found(set_of({{map_of("a_Specular.png", {value, value, value}), uses}}));
  };
  const Value stored = [](double, double y) { return y < 0.9 ? 0.2195 : 0.9; };  // an F0 of 0.04 in sRGB
  const Value linear = [](double, double y) { return y < 0.9 ? 0.04 : 0.9; };
  CHECK(specular(stored) == Names{});
  CHECK(specular(linear) == Names{"specular-color"});
  CHECK(specular([](double, double) { return 0.0; }) == Names{"specular-color"});
  CHECK(specular([](double, double) { return 1.0; }) == Names{"specular-color"});
  // the map is a level, not F0
  CHECK(specular(linear, {use_of(Role::kMetallic, Channels::kRed)}) == Names{});
}

TEST_CASE("rules: metallic in another channel than the name says") {
  const Value binary = [](double x, double y) {
    return std::sin(8.0 * x) * std::sin(6.0 * y) > 0.3 ? 1.0 : 0.0;
  };
  const Value white = [](double, double) { return 1.0; };
  const std::vector<MaterialUse> orm = {use_of(Role::kOcclusion, Channels::kRed),
                                        use_of(Role::kRoughness, Channels::kGreen),
                                        use_of(Role::kMetallic, Channels::kBlue)};
  CHECK(found(set_of({{map_of("a_ORM.png", {white, rough, binary}), orm}})) == Names{});
  CHECK(found(set_of({{map_of("a_ORM.png", {white, binary, rough}), orm}})) == Names{"channel-order"});
}

TEST_CASE("check: what assets state, and files that are not assets") {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder.path() / name) << text;
    return folder.path() / name;
  };
  const auto rules_of = [&](const std::filesystem::path& path) {
    Names names;
    for (const CheckedMaterial& material : materials_of(path, built_in_naming()).materials)
      for (const std::string& name : found(material, &gltf_consumers()[3])) names.push_back(name);
    return names;
  };
  CHECK(rules_of(write("a.gltf", R"({"materials": [{"pbrMetallicRoughness": {"metallicFactor": 0},
                        "extensions": {"KHR_materials_ior": {"ior": 1000}}}]})")) ==
        Names{"ior", "ignored-by-reader"});
  CHECK(rules_of(write("b.mtl", "newmtl a\nNs 0.3\nnewmtl b\nNs 0.9\n")) == Names{"exponent-range"});
  CHECK(rules_of(write("c.mtl", "newmtl a\nNs 96.078431\nnewmtl b\nNs 250\n")) == Names{});
  CHECK(materials_of(write("d.gltf", "{"), built_in_naming()).problems.size() == 1);
  CHECK(materials_of(write("e.glb", "glTF" + std::string("\2\0\0\0\26\0\0\0", 8) + "\xff\xff\xff\x7fJSON{}"),
                     built_in_naming())
            .problems.front()
            .find("is cut off") != std::string::npos);
  // A factor that no conversion can read is a problem, but the other materials are still checked.
  const FoundMaterials some = materials_of(
      write("f.gltf",
            R"({"materials": [{"name": "bad", "pbrMetallicRoughness": {"metallicFactor": "x"}}, {}]})"),
      built_in_naming());
  CHECK(some.materials.size() == 1);
  REQUIRE(some.problems.size() == 1);
  CHECK(some.problems.front().ends_with(
      "f.gltf: material \"bad\": metallicFactor: expected a number from 0 to 1, found \"x\""));
  CHECK_THROWS_WITH(materials_of(folder.path() / "missing", built_in_naming()),
                    Catch::Contains("does not exist"));
}
