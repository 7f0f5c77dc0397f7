// remapc warp with poor materials and strokes: an error, or a warning and the best possible result.
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "cli/warp_materials.hpp"

using namespace remap;
using namespace remap::warp_cli;

namespace {

WarpTexel torn_texel(const Latent& at) {
  WarpTexel texel = source_texel(at);
  if (at.u > 0.99) texel[1] = std::numeric_limits<float>::quiet_NaN();
  return texel;
}
// A Lambertian material, as a diffuse map alone represents it.
WarpTexel albedo_texel(const Latent& at) {
  const auto u = static_cast<float>(at.u), v = static_cast<float>(at.v);
  return {0.1f + 0.4f * u, 0.1f + 0.3f * v * v, 0.05f + 0.1f * u * v, 0, 0, 0, 1};
}
WarpTexel grey_albedo_texel(const Latent& at) {
  const auto u = static_cast<float>(at.u);
  return {0.1f + 0.4f * u, 0.1f + 0.4f * u, 0.1f + 0.4f * u, 0, 0, 0, 1};
}

void keep_diffuse_alone(const Session& session, const std::string& folder) {
  std::filesystem::remove(session.path(folder + "/skin_specular.exr"));
  std::filesystem::remove(session.path(folder + "/skin_roughness.exr"));
}

nlohmann::json report_of(const Session& session, const Words& more) {
  return nlohmann::json::parse(require_success(run_warp(session, more + "--json")).output);
}

}  // namespace

TEST_CASE("remapc warp: a material without finite values is refused") {
  const Session session;
  write_materials(session);
  write_set(session, "wood", 0.1, [](const Latent&) {
    WarpTexel texel{};
    texel.fill(std::numeric_limits<float>::quiet_NaN());
    return texel;
  });
  const ProcessResult result = run_warp(session, mask_words());
  check_failure(result, 1, "wood: contains no texel with finite values");
  CHECK_FALSE(std::filesystem::exists(session.path("stony.json")));
}

TEST_CASE("remapc warp: one or two strokes do not determine all directions, with a warning", "[slow]") {
  const Session session;
  write_materials(session);
  for (const std::size_t pairs : {std::size_t{1}, std::size_t{2}}) {
    const auto json = report_of(session, mask_words(pairs));
    CHECK(json["diagnostics"]["fixed_directions"] == pairs - 1);
    const std::string warnings = json["warnings"].dump();
    CAPTURE(warnings);
    CHECK(warnings.find("strokes do not determine direction 2 of 2") != std::string::npos);
    CHECK((warnings.find("strokes do not determine direction 1 of 2") != std::string::npos) == (pairs == 1));
  }
}

TEST_CASE("remapc warp: a region marked twice with different partners gives a warning") {
  const Session session;
  write_materials(session);
  Words words = mask_words();
  // Marks the first corner again, as the partner of the template's opposite corner, by other texels, because
  // strokes within other strokes are refused.
  write_image(session.path("again.png"), test_spec(kSize, kSize, {"Y"}, OIIO::TypeUInt8),
              [](int x, int y, int) {
                const Latent at = latent(x, y, 0.1);
                return at.u < 0.25 && at.v < 0.25 && corner_of(at) < 0 ? 1.0f : 0.0f;
              });
  words += "--stroke again.png stone_3.png";
  write_image(session.path("other.png"), test_spec(kSize, kSize, {"Y"}, OIIO::TypeUInt8),
              [](int x, int y, int) {
                const Latent at = latent(x, y, 0.37);
                return at.u > 0.75 && at.v > 0.75 && corner_of(at) < 0 ? 1.0f : 0.0f;
              });
  words.back() = session.path("other.png");
  const std::string warnings = report_of(session, words)["warnings"].dump();
  CAPTURE(warnings);
  CHECK(warnings.find("strokes contradict each other") != std::string::npos);
}

TEST_CASE("remapc warp: texels that are not finite are counted and do not affect the others") {
  const Session session;
  write_materials(session);
  write_set(session, "wood", 0.1, torn_texel);
  std::size_t torn = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) torn += latent(x, y, 0.1).u > 0.99 ? 1u : 0u;
  REQUIRE(torn > 10);
  const auto json = report_of(session, mask_words());
  CHECK(json["diagnostics"]["source_texels_left_out"] == torn);
  CHECK(json["warnings"].dump().find(std::to_string(torn) +
                                     " texels of the source and 0 of the template are not finite") !=
        std::string::npos);
  CHECK(error_of(read_warp(session), source_texel) < 0.25);
}

TEST_CASE("remapc warp: a diffuse map alone is a source, distinguished by its color", "[slow]") {
  const Session session;
  write_materials(session);
  write_set(session, "wood", 0.1, albedo_texel);
  keep_diffuse_alone(session, "wood");
  const ProcessResult result = require_success(run_warp(session, mask_words()));
  CHECK(result.errors.find("the source has a diffuse map only") != std::string::npos);
  const WarpMapFit fit = read_warp(session);
  CHECK(is_of_diffuse_alone(fit));
  CHECK(error_of(fit, albedo_texel) < 0.25);
  const ProcessResult card = session.remapc("show stony.json");
  CHECK(card.output.find("source_maps") != std::string::npos);

  write_set(session, "wood", 0.1, grey_albedo_texel);
  keep_diffuse_alone(session, "wood");
  const std::string warnings = report_of(session, mask_words())["warnings"].dump();
  CAPTURE(warnings);
  CHECK(warnings.find("the source varies in 1 dimension and the template in 2") != std::string::npos);
}
