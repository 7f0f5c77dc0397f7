// This file tests maps of different sizes. The resampling of OpenImageIO is the reference for values between
// texels.
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

ProcessResult convert(const Session& session, Words words, const std::string& folder) {
  return session.texremap(Words("convert --from mitsuba/ward --to mitsuba/as") + words + "-o " + folder);
}

// Writes the image `name` of the session at another size, linearly interpolated, as floats.
void write_resampled(const Session& session, const std::string& name, int width, int height,
                     const std::string& result) {
  const OIIO::ImageBuf source(session.path(name));
  OIIO::ImageBuf target(OIIO::ImageSpec(width, height, source.nchannels(), OIIO::TypeFloat));
  REQUIRE(OIIO::ImageBufAlgo::resample(target, source, true));
  REQUIRE(target.write(session.path(result)));
}

float largest_difference(const TestImage& a, const TestImage& b) {
  float largest = 0.0f;
  for (int y = 0; y < a.spec.height; ++y)
    for (int x = 0; x < a.spec.width; ++x)
      for (int c = 0; c < a.spec.nchannels; ++c)
        largest = std::max(largest, std::fabs(a.at(x, y, c) - b.at(x, y, c)));
  return largest;
}

}  // namespace

TEST_CASE("texremap --resample: the smaller map is interpolated as OpenImageIO does", "[slow]") {
  const Session session;
  const bool tiled = GENERATE(false, true);
  const auto [small, large] = GENERATE(std::pair{16, 64}, std::pair{40, 100}, std::pair{1, 70});
  OIIO::ImageSpec small_spec = test_spec(small, small, {"R", "G", "B"}, OIIO::TypeFloat);
  if (tiled) small_spec.tile_width = small_spec.tile_height = 16;
  session.make("s.exr", small_spec, noise);
  session.make("r.exr", test_spec(large, large - 7, {"Y"}, OIIO::TypeFloat), noise);
  write_resampled(session, "s.exr", large, large - 7, "s_large.exr");
  const ProcessResult result =
      require_success(convert(session, "--roughness r.exr --specular s.exr --resample --threads 1", "out"));
  CHECK_THAT(result.errors, Contains("s.exr: resampled to " + std::to_string(large) + "x"));
  require_success(convert(session, "--roughness r.exr --specular s_large.exr", "expected"));
  const TestImage out = session.image("out/s.exr"), expected = session.image("expected/s_large.exr");
  REQUIRE(out.spec.width == large);
  REQUIRE(out.spec.height == large - 7);
  CHECK(out.spec.tile_width == small_spec.tile_width);
  CHECK(largest_difference(out, expected) < 2e-6f);  // both interpolate with floats
  // Target alpha depends on the resampled specular, so it may differ as much.
  CHECK(largest_difference(session.image("out/r.exr"), session.image("expected/r.exr")) < 2e-6f);
}

TEST_CASE("texremap --resample: bands of tall maps meet without a seam", "[slow]") {
  const Session session;
  session.make("r.png", test_spec(64, 1500, {"Y"}, OIIO::TypeUInt16),
               [](int, int y, int) { return static_cast<float>(y) / 1500.0f; });
  session.make("s.png", test_spec(8192, 3000, {"Y"}, OIIO::TypeUInt8), [](int, int, int) { return 0.5f; });
  require_success(convert(session, "--roughness r.png --specular s.png --resample --only roughness", "out"));
  const TestImage out = session.image("out/r.png");
  REQUIRE(out.spec.height == 3000);
  for (int y = 1; y < 3000; ++y) {
    INFO("row " << y);
    REQUIRE(out.at(5, y, 0) >= out.at(5, y - 1, 0));  // a ramp stays monotonic
    REQUIRE(out.at(5, y, 0) - out.at(5, y - 1, 0) < 2e-3f);
  }
}

TEST_CASE("texremap --resample: sRGB color is interpolated as linear light") {
  const Session session;
  session.make("s.png", test_spec(2, 1, {"R", "G", "B"}, OIIO::TypeUInt8),
               [](int x, int, int) { return x == 0 ? 0.0f : 1.0f; });
  session.make("r.png", test_spec(4, 1, {"Y"}, OIIO::TypeUInt8), [](int, int, int) { return 0.3f; });
  require_success(
      convert(session, "--roughness r.png --specular s.png --color-space srgb --resample", "out"));
  const TestImage out = session.image("out/s.png");
  // The texel is a quarter of the way from black to white, in linear light.
  const float linear = converted_texel(as_stored(0.3f, OIIO::TypeUInt8), {0.25f, 0.25f, 0.25f})[1];
  const double stored = linear_to_srgb(static_cast<double>(linear));
  CHECK(out.at(1, 0, 0) == as_stored(static_cast<float>(stored), OIIO::TypeUInt8));
}

TEST_CASE("texremap --resample: all channels of a packed roughness map are resampled") {
  const Session session;
  session.make("orm.png", test_spec(20, 20, {"R", "G", "B"}, OIIO::TypeUInt8), noise);
  session.make("s.png", test_spec(40, 40, {"Y"}, OIIO::TypeUInt8), noise);
  write_resampled(session, "orm.png", 40, 40, "orm_large.tif");
  require_success(convert(session, "--roughness orm.png:G --specular s.png --resample", "out"));
  const TestImage out = session.image("out/orm.png"), expected = session.image("orm_large.tif");
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x)
      REQUIRE(std::fabs(out.at(x, y, 0) - expected.at(x, y, 0)) <= 0.501f / 255.0f);
}
