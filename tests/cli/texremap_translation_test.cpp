// This file tests conversions of texture sets between models of whole materials. Results are compared with
// the generated header, texel by texel.
#include <algorithm>

#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"
#include "generated/materials/materials.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

constexpr int kSide = kMapSize;

float level(int x, int y, int c) { return 0.05f + 0.9f * noise(x, y, c); }

// Writes maps of a coated material, as floats.
void write_coated(const Session& session) {
  const auto make = [&](const char* name, const Names& channels, int seed) {
    const auto texel = [seed](int x, int y, int c) { return level(x, y, c + seed); };
    session.map(name, channels, texel, OIIO::TypeFloat, kSide);
  };
  make("b.exr", kColor, 0);
  make("m.exr", kGrey, 5);
  make("r.exr", kGrey, 7);
  make("coat.exr", kGrey, 9);
}

const Words kCoated = "--base-color b.exr --metallic m.exr --roughness r.exr --input coat_weight=coat.exr";

nlohmann::json translated(const Session& session, const Words& words) {
  return session.json(Words("convert -o out --json") + words);
}

materials::Color color_at(const TestImage& image, int x, int y) {
  return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
}

}  // namespace

TEST_CASE("texremap translation: Blender to OpenPBR equals the header") {
  const Session session;
  write_coated(session);
  const auto json =
      translated(session,
                 "--from blender --to openpbr --input coat_roughness=0.25 --factor metallic=0.5 "
                 "--input coat_tint=0.9,0.5,0.2" +
                     kCoated);
  const TestImage b = session.image("b.exr"), m = session.image("m.exr"), r = session.image("r.exr"),
                  coat = session.image("coat.exr"), base = session.image("out/b.exr"),
                  metalness = session.image("out/m.exr"), weight = session.image("out/coat.exr");
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      materials::Principled source;
      source.base_color = color_at(b, x, y);
      source.metallic = 0.5f * m.at(x, y, 0);
      source.roughness = r.at(x, y, 0);
      source.coat_weight = coat.at(x, y, 0);
      source.coat_roughness = 0.25f;
      source.coat_tint = {0.9f, 0.5f, 0.2f};
      const auto expected = materials::principled_to_open_pbr_surface(source);
      for (int c = 0; c < 3; ++c) REQUIRE(base.at(x, y, c) == Approx(expected.base_color[c]).margin(1e-6));
      REQUIRE(metalness.at(x, y, 0) == Approx(expected.base_metalness).margin(1e-6));
      REQUIRE(weight.at(x, y, 0) == Approx(expected.coat_weight).margin(1e-6));
    }
  CHECK(json["constants"]["coat_roughness"].get<float>() == Approx(0.25f));
  CHECK(json["lost"].empty());
  CHECK(json["source"] == "cycles-5/principled");
  CHECK(json["target"] == "openpbr");
}

TEST_CASE("texremap translation: maps whose values stay are copied byte for byte") {
  const Session session;
  session.map("b.png", kColor, level);
  session.map("orm.png", kColor, level);
  const auto json = translated(session,
                               "--from blender --to openpbr --base-color b.png --metallic orm.png:B "
                               "--roughness orm.png:G");
  CHECK(read_file(session.path("out/b.png")) == read_file(session.path("b.png")));
  CHECK(read_file(session.path("out/orm.png")) == read_file(session.path("orm.png")));
  CHECK(json["results"].size() == 2);
}

TEST_CASE("texremap translation: OpenPBR to USD makes maps that the source lacks, and names what is lost") {
  const Session session;
  write_coated(session);
  const auto json = translated(session,
                               "--from openpbr --to usd --format exr --type float --input fuzz_weight=0.5 "
                               "--input coat_color=0.5,1,1 " +
                                   kCoated);
  const TestImage b = session.image("b.exr"), m = session.image("m.exr"), r = session.image("r.exr"),
                  coat = session.image("coat.exr"), roughness = session.image("out/roughness.exr"),
                  ior = session.image("out/ior.exr");
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      materials::OpenPbrSurface source;
      source.base_color = color_at(b, x, y);
      source.base_metalness = m.at(x, y, 0);
      source.specular_roughness = r.at(x, y, 0);
      source.coat_weight = coat.at(x, y, 0);
      source.coat_color = {0.5f, 1.0f, 1.0f};
      source.fuzz_weight = 0.5f;
      const auto expected = materials::open_pbr_surface_to_UsdPreviewSurface(source);
      REQUIRE(roughness.at(x, y, 0) == Approx(expected.roughness).margin(1e-6));
      REQUIRE(ior.at(x, y, 0) == Approx(expected.ior).margin(1e-6));
    }
  CHECK(json["lost"] == nlohmann::json{"fuzz_weight"});
}

TEST_CASE("texremap translation: sets of folders are found by the names of their inputs") {
  const Session session;
  for (const std::string name : {"car_BaseColor", "car_Normal", "shirt_base_color"})
    session.map("sets/" + name + ".png", kColor, level);
  for (const std::string name :
       {"car_Roughness", "car_Metallic", "car_Coat_Opacity", "car_Coat_Roughness", "shirt_sheen_weight"})
    session.map("sets/" + name + ".png", kGrey, level);
  require_success(
      session.texremap("convert sets --from openpbr --to standard-surface --input coat_ior=1.5 -o out"));
  for (const char* file : {"car_BaseColor.png", "car_Coat_Opacity.png", "car_Coat_Roughness.png",
                           "car_Normal.png", "shirt_base_color.png"})
    CHECK(session.exists(std::string("out/") + file));
  // Fuzz of OpenPBR darkens what lies below it, so that the weight changes more than its own input.
  CHECK(session.exists("out/shirt_sheen_weight.png"));
}

TEST_CASE("texremap translation: results of a folder are read again, also an index of refraction") {
  const Session session;
  session.map("sets/car_BaseColor.png", kColor, level);
  for (const std::string name : {"Roughness", "Coat", "mine"})
    session.map("sets/car_" + name + ".png", kGrey, level);
  const Words words = "convert sets --from blender --to openpbr -o middle --json";
  const ProcessResult there = require_success(session.texremap(words));
  CHECK_THAT(there.output, Contains("middle/car_ior.exr") && Contains("car_mine.png"));
  require_success(
      session.texremap("convert middle --from openpbr --to usd -o end --input coat_roughness=0.03 "
                       "--input coat_ior=1.5 --input coat_darkening=0"));
  const TestImage weight = session.image("end/car_coat_weight.png"),
                  source = session.image("sets/car_Coat.png");
  float largest = 0.0f;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) largest = std::max(largest, weight.at(x, y, 0));
  CHECK(largest > 0.5f);

  // A file that a pattern names is recognised, and is used instead of the map of the set.
  const auto other = require_success(session.texremap(
      "convert sets --from blender --to openpbr -o other --json --input coat_weight=*_mine.png"));
  CHECK_FALSE(session.exists("other/car_Coat.png"));
  CHECK_THAT(other.output, Contains("\"unrecognised_images\":[]"));
}

TEST_CASE("texremap translation: numbers print the inputs that differ from their defaults") {
  const Session session;
  const Words words =
      "convert --from usd --to openpbr --base-color 0.8,0.1,0.1 --roughness 0.4 --metallic 0 "
      "--input clearcoat=1 --input ior=1.7";
  const ProcessResult text = require_success(session.texremap(words));
  CHECK_THAT(text.output, Contains("coat_weight 1\n") && Contains("specular_roughness 0.4\n"));
  const auto json = session.json(words + "--json");
  materials::UsdPreviewSurface source;
  source.diffuseColor = {0.8f, 0.1f, 0.1f};
  source.roughness = 0.4f;
  source.clearcoat = 1.0f;
  source.ior = 1.7f;
  const auto expected = materials::UsdPreviewSurface_to_open_pbr_surface(source);
  const auto values = json["values"];
  CHECK(json["lost"].empty());
  CHECK(json["expected_error"].is_null());
  CHECK(values["specular_ior"].get<float>() == Approx(expected.specular_ior));
  CHECK(values["coat_weight"].get<float>() == Approx(expected.coat_weight));
  CHECK(values["base_color"][0].get<float>() == Approx(expected.base_color.r));
}

TEST_CASE("texremap translation: OpenPBR packs its maps for an engine") {
  const Session session;
  session.map("b.png", kColor, level);
  session.map("r.png", kGrey, level);
  require_success(
      session.texremap("convert --from openpbr --to unity --base-color b.png --roughness r.png --metallic 1 "
                       "-o out"));
  const TestImage roughness = session.image("r.png");
  const TestImage mask = session.image("out/MetallicSmoothness.png");
  CHECK(mask.at(3, 4, 0) == 1.0f);
  CHECK(mask.at(3, 4, 3) == Approx(1.0f - roughness.at(3, 4, 0)).margin(0.003));
}
