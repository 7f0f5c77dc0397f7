// This file tests previews of texture sets. A ball with uniform maps must equal a sphere with the same
// numbers, each texel must appear at its place on the ball, and the errors must follow from the conversion.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "look/brdf.hpp"
#include "look/lit_sphere.hpp"
#include "look/scene.hpp"
#include "report/preview.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_image.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

constexpr int kBall = 48;

Environment studio() { return std::get<Environment>(preview_light("studio", 3.0, 1.0).light); }

SphereSampling coarse() {
  SphereSampling sampling;
  sampling.resolution = kBall;
  sampling.samples = 64;
  return sampling;
}

// Writes a metallic set of tiles: one quarter of it is metal.
void write_set(const TemporaryFolder& folder) {
  std::filesystem::create_directories(folder.path() / "sets");
  const auto write = [&](const std::string& name, const std::vector<std::string>& channels,
                         const TexelFunction& f) {
    write_image(folder.path() / "sets" / name, test_spec(64, 64, channels, OIIO::TypeUInt8), f);
  };
  write("tile_basecolor.png", {"R", "G", "B"}, [](int, int, int c) { return c == 0 ? 0.8f : 0.3f; });
  write("tile_metallic.png", {"Y"}, [](int x, int y, int) { return x < 32 && y < 32 ? 1.0f : 0.0f; });
  write("tile_roughness.png", {"Y"}, [](int x, int, int) { return 0.3f + 0.005f * static_cast<float>(x); });
}

SetPreview preview_of(const TemporaryFolder& folder, const std::string& from, const std::string& to) {
  ConvertOptions options;
  options.folder = folder.path() / "sets";
  options.from = model_named(from);
  options.to = model_named(to);
  options.output = folder.path() / "out";
  options.dry_run = true;
  SetPreviewOptions shown;
  shown.light = studio();
  shown.resolution = kBall;
  shown.directions = 64;
  return preview_sets(resolve(options), shown);
}

}  // namespace

TEST_CASE("set preview: a ball of uniform maps equals the sphere of the same numbers") {
  const Environment light = studio();
  const RadiancePyramid pyramid(std::span(&light, 1), 64);
  const BrdfModel model = builtin_brdf(GENERATE("mitsuba/ggx", "mitsuba/ward", "mitsuba/as"));
  const std::array<SphereMaterial, 1> material = {{{model, 0.2, 0.6, 0.3}}};
  const std::vector<float> expected = render_spheres(pyramid, material, coarse()).radiance(0, 0);
  const TexturedBall ball{model, 3, 2, std::vector<BallTexel>(6, {0.2, {0.6, 0.6, 0.6}, {0.3, 0.3, 0.3}})};
  const std::vector<float> found = render_textured(pyramid, std::span(&ball, 1), {}, coarse()).front();
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) REQUIRE(found[i] == Approx(expected[i]).epsilon(1e-4));
}

TEST_CASE("set preview: the left of a map is at the left of the ball, its first row at the top") {
  const Environment light = exposed(builtin_environments(16)[1], 1.0);  // overcast
  const RadiancePyramid pyramid(std::span(&light, 1), 64);
  TexturedBall ball{builtin_brdf("mitsuba/ggx"), 2, 2, std::vector<BallTexel>(4, {0.5, {}, {}})};
  ball.texels[0].diffuse = {1.0, 0.0, 0.0};
  ball.texels[3].diffuse = {0.0, 1.0, 0.0};
  const std::vector<float> picture = render_textured(pyramid, std::span(&ball, 1), {}, coarse()).front();
  const std::vector<std::uint32_t> pixels = shape_pixels(Shape::kSphere, kBall);
  const auto at = [&](int x, int y, std::size_t channel) {
    const auto place = std::ranges::find(pixels, static_cast<std::uint32_t>(y * kBall + x));
    REQUIRE(place != pixels.end());
    return picture[3 * static_cast<std::size_t>(place - pixels.begin()) + channel];
  };
  CHECK(at(12, 14, 0) > 2.0f * at(12, 14, 1));
  CHECK(at(35, 33, 1) > 2.0f * at(35, 33, 0));
}

TEST_CASE(
    "set preview: normals out of the surface change nothing, normals to the camera make the ball flat") {
  const Environment light = builtin_environments(16)[1];  // overcast: darker towards the ground
  const RadiancePyramid pyramid(std::span(&light, 1), 64);
  const TexturedBall ball{builtin_brdf("mitsuba/ggx"), 1, 1, {{0.5, {}, {0.8, 0.8, 0.8}}}};
  SphereSampling sampling = coarse();
  sampling.samples = 2048;
  const auto rendered = [&](const Image& normals) {
    return render_textured(pyramid, std::span(&ball, 1), normals, sampling).front();
  };
  CHECK(rendered({1, 1, 3, {0.0f, 0.0f, 1.0f}}) == rendered({}));

  // The camera's direction (0, 0, 1) in the frame of each texel: along the rows to the right, up, and out.
  constexpr int kSide = 96;
  Image facing{kSide, kSide, 3, {}};
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      const double polar = std::numbers::pi * (row + 0.5) / kSide,
                   azimuth = std::numbers::pi * ((column + 0.5) / kSide - 0.5);
      for (const double value :
           {-std::sin(azimuth), -std::cos(polar) * std::cos(azimuth), std::sin(polar) * std::cos(azimuth)})
        facing.values.push_back(static_cast<float>(value));
    }
  const std::vector<float> flat = rendered(facing), round = rendered({});
  const std::vector<std::uint32_t> pixels = shape_pixels(Shape::kSphere, kBall);
  const auto at = [&](const std::vector<float>& picture, int y) {
    const auto place = std::ranges::find(pixels, static_cast<std::uint32_t>(y * kBall + kBall / 2));
    return picture[3 * static_cast<std::size_t>(place - pixels.begin())];
  };
  CHECK(at(round, 8) > 1.5f * at(round, kBall - 8));
  for (int y = 8; y <= kBall - 8; ++y) CHECK(at(flat, y) == Approx(at(flat, kBall / 2)).epsilon(0.05));
}

TEST_CASE("set preview: a set that does not change looks the same, and Blender's set in three.js nearly so",
          "[needs]") {
  const TemporaryFolder folder;
  write_set(folder);
  const SetPreview same = preview_of(folder, "gltf", "gltf");
  REQUIRE(same.figures.size() == 1);
  CHECK(same.figures[0].name == "tile");
  CHECK(same.figures[0].converted.rms < 1e-6);
  CHECK(same.notes.empty());

  const SetPreview other = preview_of(folder, "blender", "threejs");
  REQUIRE(other.figures[0].copied);
  CHECK(other.figures[0].converted.rms < 0.5 * other.figures[0].copied->rms);
  CHECK(other.labels.columns.size() == 3);
  REQUIRE(other.notes.size() == 2);
  CHECK_THAT(other.notes[0], Contains("is shown as mitsuba/ggx"));

  // The set has only roughness and specular, without a diffuse lobe.
  std::filesystem::rename(folder.path() / "sets/tile_basecolor.png",
                          folder.path() / "sets/tile_specular.png");
  const SetPreview lobe = preview_of(folder, "mitsuba/ward", "mitsuba/as");
  CHECK(lobe.figures[0].converted.rms < lobe.figures[0].copied->rms);
  std::filesystem::rename(folder.path() / "sets/tile_specular.png",
                          folder.path() / "sets/tile_basecolor.png");

  const SetPreview across = preview_of(folder, "gltf", "gltf-specgloss");
  CHECK_FALSE(across.figures[0].copied);
  CHECK(across.labels.columns.size() == 2);
  CHECK(across.figures[0].converted.rms < 0.02);
}
