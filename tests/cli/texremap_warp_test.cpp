// This file tests warps of maps against the same warp in double precision.
#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"
#include "lower/fit_file.hpp"
#include "support/random_warp.hpp"
#include "support/skip.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

constexpr int kWarpSize = 50;

// A WarpSession is a folder with a set and a warp. Roughness is the square root of alpha.
struct WarpSession : Session {
  WarpMapFit fit;
  explicit WarpSession(const std::string& source_model = "mitsuba/ward") {
    fit.id = "stony";
    fit.source_model = source_model;
    fit.template_model = "mitsuba/ggx";
    fit.warp = random_warp(2, 4);
    fit.tool_version = "1.0.0";
    write_file(path("stony.json"), fit_to_json(fit));
    std::filesystem::create_directories(path("wood"));
    write_image(path("wood/oak_diffuse.exr"),
                test_spec(kWarpSize, kWarpSize, {"R", "G", "B"}, OIIO::TypeFloat), noise);
    write_image(path("wood/oak_specular.exr"),
                test_spec(kWarpSize, kWarpSize, {"R", "G", "B"}, OIIO::TypeFloat),
                [](int x, int y, int c) { return 0.5f * noise(x, y, c + 3); });
    write_image(path("wood/oak_roughness.exr"), test_spec(kWarpSize, kWarpSize, {"Y"}, OIIO::TypeFloat),
                [](int x, int y, int) { return 0.2f + 0.8f * noise(x, y, 6); });
  }
  // Compares each texel of the results with the warp of the texel that `given` returns for it.
  template <typename Given>
  void check_warped(const std::string& stem, const Given& given) const {
    const TestImage diffuse = image(stem + "diffuse.exr"), specular = image(stem + "specular.exr"),
                    roughness = image(stem + "roughness.exr");
    REQUIRE(specular.spec.nchannels == 3);
    REQUIRE(roughness.spec.nchannels == 1);
    for (int y = 0; y < kWarpSize; ++y)
      for (int x = 0; x < kWarpSize; ++x) {
        const WarpTexel expected = evaluate_warp(fit.warp, given(x, y));
        for (int c = 0; c < 3; ++c) {
          REQUIRE(diffuse.at(x, y, c) == Approx(expected[static_cast<std::size_t>(c)]).margin(1e-4));
          REQUIRE(specular.at(x, y, c) == Approx(expected[static_cast<std::size_t>(3 + c)]).margin(1e-4));
        }
        const float root = roughness.at(x, y, 0);
        REQUIRE(root * root == Approx(expected[6]).margin(1e-4));
      }
  }
};

// Returns the texels of oak. Its grey specular map is used for three channels.
auto oak_texels(const Session& session) {
  return [diffuse = session.image("wood/oak_diffuse.exr"), specular = session.image("wood/oak_specular.exr"),
          roughness = session.image("wood/oak_roughness.exr")](int x, int y) {
    const auto f0 = [&](int c) { return specular.at(x, y, std::min(c, specular.spec.nchannels - 1)); };
    const float root = roughness.at(x, y, 0);
    return WarpTexel{diffuse.at(x, y, 0), diffuse.at(x, y, 1), diffuse.at(x, y, 2), f0(0), f0(1), f0(2),
                     root * root};
  };
}

}  // namespace

TEST_CASE(
    "texremap warps: every texel of a folder equals the warp; grey maps become colors under their names",
    "[needs][slow]") {
  const WarpSession session;
  const std::string set = GENERATE("baseline", "avx2");
  const bool is_grey = GENERATE(false, true);
  if (set == "avx2" && !has_avx2()) return;
  if (is_grey)
    session.make("wood/oak_specular.exr", test_spec(kWarpSize, kWarpSize, {"Y"}, OIIO::TypeFloat),
                 [](int x, int y, int) { return 0.5f * noise(x, y, 3); });
  require_success(session.texremap_with(set, "convert wood --converters stony.json -o out"));
  session.check_warped("out/oak_", oak_texels(session));
}

TEST_CASE("texremap warps: a set converted to the source of the warp needs no --force", "[slow]") {
  const WarpSession session("mitsuba/ggx");
  std::filesystem::create_directories(session.path("metal"));
  session.make("metal/oak_basecolor.exr", test_spec(kWarpSize, kWarpSize, {"R", "G", "B"}, OIIO::TypeFloat),
               noise);
  for (const char* name : {"metallic", "roughness"})
    session.make(std::string("metal/oak_") + name + ".exr",
                 test_spec(kWarpSize, kWarpSize, {"Y"}, OIIO::TypeFloat), noise);
  const auto convert = [&](const std::string& from, const Words& more, const std::string& to) {
    return session.texremap("convert " + from + " -o " + to + more);
  };
  const Words by_warp = "--converters stony.json";
  require_success(convert("metal", "--from metallic --to specular", "plain"));
  require_success(convert("plain", by_warp, "plain_out"));
  require_success(convert("plain_out", "--from specular --to metallic", "metal_again"));
  require_success(convert("metal_again", "--converters stony.json --from metallic:mitsuba/ggx", "again_out"));

  // glTF's diffuse is scaled by the light that specular does not reflect, so it is a different material.
  require_success(convert("metal", "--from metallic --to gltf-specgloss", "scaled"));
  const ProcessResult scaled = convert("scaled", by_warp, "scaled_out");
  CHECK(scaled.exit_code != 0);
  CHECK_THAT(scaled.errors, Contains("already converted to gltf-specgloss"));
  const ProcessResult metallic =
      convert("metal_again", "--from specular --to mitsuba/ward --specular 0.04", "ward_out");
  CHECK(metallic.exit_code != 0);
  CHECK_THAT(metallic.errors, Contains("already converted to metallic"));
}

namespace {

// An AlbedoSession has a warp of only a diffuse map, and a folder with only such maps.
struct AlbedoSession : WarpSession {
  AlbedoSession() : WarpSession("mitsuba/ggx") {
    fit.method[kWarpSourceMaps] = kDiffuseAlone;
    write_file(path("stony.json"), fit_to_json(fit));
    std::filesystem::remove(path("wood/oak_specular.exr"));
    std::filesystem::remove(path("wood/oak_roughness.exr"));
  }
};

}  // namespace

TEST_CASE("texremap warps: a diffuse map alone becomes a set of three maps", "[slow]") {
  const AlbedoSession session;
  const bool by_folder = GENERATE(true, false);
  const std::string map = session.path("wood/oak_diffuse.exr");
  Words words = "convert --converters stony.json -o out";
  if (by_folder)
    words.push_back(session.path("wood"));
  else
    words += "--diffuse " + map;
  require_success(session.texremap(words));
  const TestImage diffuse = read_image(map);
  session.check_warped(by_folder ? "out/oak_" : "out/", [&](int x, int y) {
    return WarpTexel{diffuse.at(x, y, 0), diffuse.at(x, y, 1), diffuse.at(x, y, 2), 0, 0, 0, 1};
  });
}

TEST_CASE("texremap warps: a warp of a diffuse map alone converts tiles") {
  const AlbedoSession session;
  std::filesystem::create_directories(session.path("tiles"));
  for (const char* tile : {"1001", "1002"})
    session.make(std::string("tiles/oak_diffuse.") + tile + ".png",
                 test_spec(8, 8, {"R", "G", "B"}, OIIO::TypeUInt8), noise);
  require_success(session.texremap("convert tiles --converters stony.json -o out"));
  CHECK(session.result_count() == 6);
  CHECK(std::filesystem::exists(session.path("out/oak_roughness.1002.png")));
}
