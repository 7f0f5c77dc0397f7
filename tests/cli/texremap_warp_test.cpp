// Warps over maps, against the same warp in double precision.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/texremap_session.hpp"
#include "files.hpp"
#include "model/fit_json.hpp"
#include "support/random_warp.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

constexpr int kSize = 50;

// A folder with a set and a warp; roughness is the root of alpha.
struct WarpSession : Session {
  WarpMapFit fit;
  WarpSession() {
    fit.id = "stony";
    fit.source_model = "mitsuba/ward";
    fit.template_model = "mitsuba/ggx";
    fit.warp = random_warp(2, 4);
    fit.tool_version = "1.0.0";
    write_file(path("stony.json"), fit_to_json(fit));
    std::filesystem::create_directories(path("wood"));
    write_image(path("wood/oak_diffuse.exr"), test_spec(kSize, kSize, {"R", "G", "B"}, OIIO::TypeFloat),
                noise);
    write_image(path("wood/oak_specular.exr"), test_spec(kSize, kSize, {"R", "G", "B"}, OIIO::TypeFloat),
                [](int x, int y, int c) { return 0.5f * noise(x, y, c + 3); });
    write_image(path("wood/oak_roughness.exr"), test_spec(kSize, kSize, {"Y"}, OIIO::TypeFloat),
                [](int x, int y, int) { return 0.2f + 0.8f * noise(x, y, 6); });
  }
};

}  // namespace

TEST_CASE("texremap warps: a folder becomes what the warp says of each texel") {
  const WarpSession session;
  const std::string set = GENERATE("baseline", "avx2");
  const ProcessResult result =
      session.texremap({"convert", session.path("wood"), "--fit", session.path("stony.json"),
                        "--instructions", set, "--json", "-o", session.path("out")});
  if (result.exit_code == 2 && result.errors.find("--instructions") != std::string::npos) return;
  require_success(result);
  const auto image = [&](const char* name) { return read_image(session.path(name)); };
  const TestImage diffuse = image("wood/oak_diffuse.exr"), specular = image("wood/oak_specular.exr"),
                  roughness = image("wood/oak_roughness.exr");
  const TestImage found_diffuse = image("out/oak_diffuse.exr"),
                  found_specular = image("out/oak_specular.exr"),
                  found_roughness = image("out/oak_roughness.exr");
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      WarpTexel texel{};
      for (int c = 0; c < 3; ++c) {
        texel[static_cast<std::size_t>(c)] = diffuse.at(x, y, c);
        texel[static_cast<std::size_t>(3 + c)] = specular.at(x, y, c);
      }
      texel[6] = roughness.at(x, y, 0) * roughness.at(x, y, 0);
      const WarpTexel expected = evaluate_warp(session.fit.warp, texel);
      for (int c = 0; c < 3; ++c) {
        REQUIRE(found_diffuse.at(x, y, c) == Approx(expected[static_cast<std::size_t>(c)]).margin(1e-4));
        REQUIRE(found_specular.at(x, y, c) == Approx(expected[static_cast<std::size_t>(3 + c)]).margin(1e-4));
      }
      const float alpha = found_roughness.at(x, y, 0) * found_roughness.at(x, y, 0);
      REQUIRE(alpha == Approx(expected[6]).margin(1e-4));
    }
}

TEST_CASE("texremap warps: what means nothing to them is refused, and nothing is written") {
  const WarpSession session;
  const auto refused = [&](const std::vector<std::string>& more, const std::string& message) {
    std::vector<std::string> words = {"convert", session.path("wood"), "--fit", session.path("stony.json"),
                                      "-o",      session.path("out")};
    words.insert(words.end(), more.begin(), more.end());
    const ProcessResult result = session.texremap(words);
    CHECK(result.exit_code == 2);
    CHECK_THAT(result.errors, Contains(message));
    CHECK_FALSE(std::filesystem::exists(session.path("out")));
  };
  refused({"--from", "mitsuba/as"}, "is a warp of mitsuba/ward; expected mitsuba/as of --from");
  refused({"--to-workflow", "metallic"}, "--to-workflow: means nothing to the warp");
  refused({"--smooth-metallic"}, "--smooth-metallic: is for metallic results");
  refused({"--only", "roughness"}, "--only");
  write_file(session.path("stony.json"),
             "{\"format\": \"remap-fit\", \"version\": 3, \"mapping\": {\"kind\": \"warp\"}}");
  const ProcessResult damaged = session.texremap(
      {"convert", session.path("wood"), "--fit", session.path("stony.json"), "-o", session.path("out")});
  CHECK(damaged.exit_code == 1);
  CHECK_THAT(damaged.errors, Contains("stony.json"));
}
