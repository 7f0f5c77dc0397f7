// This file tests inputs of texremap: packed channels, glossiness, numbers, factors, sRGB color, invalid
// values.
#include <cmath>
#include <cstring>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/texremap_session.hpp"
#include "remap/shipped_converters.hpp"

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

constexpr int kInputSize = 40;

// Converts from mitsuba/ward to mitsuba/as, into `out`.
ProcessResult convert_ward(const Session& session, Words words) {
  return session.texremap(Words("convert --from mitsuba/ward --to mitsuba/as") + words);
}

Words maps(const std::string& roughness, const std::string& specular) {
  return "--roughness " + roughness + " --specular " + specular + " -o out";
}

}  // namespace

TEST_CASE("texremap inputs: one channel of a packed map is converted, the others keep every bit") {
  const Session session;
  session.make("orm.png", test_spec(kInputSize, kInputSize, {"R", "G", "B"}, OIIO::TypeUInt8), noise);
  require_success(convert_ward(session, "--roughness orm.png:G --specular 0.4 --only roughness -o out"));
  CHECK(session.file_count() == 1);
  const TestImage in = session.image("orm.png"), out = session.image("out/orm.png");
  CHECK(same_channel(in, out, 0));
  CHECK(same_channel(in, out, 2));
  for (int x = 0; x < kInputSize; ++x)
    CHECK(out.at(x, 7, 1) ==
          as_stored(converted_texel(in.at(x, 7, 1), {0.4f, 0.4f, 0.4f})[0], OIIO::TypeUInt8));
}

TEST_CASE("texremap inputs: a file of specular and glossiness in alpha is data throughout", "[slow]") {
  const Session session;
  const std::string name = "sg." + std::string(GENERATE("png", "tga", "tif", "exr"));
  // Alpha is 0 or far below the colors, so that a multiplication or division by it would be visible.
  session.make(name, test_spec(kInputSize, kInputSize, {"R", "G", "B", "A"}, OIIO::TypeUInt8),
               [](int x, int y, int c) {
                 return c < 3 ? noise(x, y, c) : x < 5 ? 0.0f : 0.3f * noise(x, y, c);
               });
  const std::string path = session.path(name);
  require_success(convert_ward(session, "--glossiness " + path + ":A --specular " + path +
                                            " --color-space linear --output-encoding glossiness -o out"));
  const TestImage in = read_image(path), out = session.image("out/" + name);
  for (int y = 0; y < kInputSize; ++y)
    for (int x = 0; x < kInputSize; ++x) {
      const float roughness = 1.0f - in.at(x, y, 3);
      const std::array<float, 4> expected =
          converted_texel(roughness * roughness, {in.at(x, y, 0), in.at(x, y, 1), in.at(x, y, 2)});
      REQUIRE(out.at(x, y, 3) == Approx(1.0f - std::sqrt(expected[0])).margin(0.501 / 255.0));
      for (int c = 0; c < 3; ++c)
        REQUIRE(out.at(x, y, c) ==
                Approx(as_stored(expected[static_cast<std::size_t>(c) + 1], out.spec.format)).margin(1e-3));
    }
}

TEST_CASE("texremap inputs: factors are applied once") {
  const Session session;
  session.write_pair("exr", kInputSize);
  require_success(
      convert_ward(session, maps("r.exr", "s.exr") + "--factor roughness=0.5 --factor specular=1,0.5,0.25"));
  const TestImage r = session.image("r.exr"), s = session.image("s.exr"), out = session.image("out/s.exr"),
                  width = session.image("out/r.exr");
  for (int x = 0; x < kInputSize; ++x) {
    const auto expected =
        converted_texel(0.5f * r.at(x, 3, 0), {s.at(x, 3, 0), 0.5f * s.at(x, 3, 1), 0.25f * s.at(x, 3, 2)});
    CHECK(width.at(x, 3, 0) == as_stored(expected[0], OIIO::TypeHalf));
    for (int c = 0; c < 3; ++c)
      CHECK(out.at(x, 3, c) == as_stored(expected[static_cast<std::size_t>(c) + 1], OIIO::TypeHalf));
  }
}

TEST_CASE("texremap inputs: invalid texels are kept, clamped, or an error") {
  const Session session;
  session.write_pair("exr", kInputSize);
  session.make("s.exr", test_spec(kInputSize, kInputSize, {"R", "G", "B"}, OIIO::TypeFloat),
               [](int x, int y, int c) {
                 if (y == 4 && c == 1) return x == 6 ? NAN : x == 7 ? INFINITY : x == 8 ? -2.0f : 0.2f;
                 return 0.2f;
               });
  const Words words = maps("r.exr", "s.exr") + "--json --force --nan";
  const ProcessResult kept = require_success(convert_ward(session, words + "keep"));
  const auto json = nlohmann::json::parse(kept.output);
  CHECK(json["first_bad"] == std::vector<int>{6, 4});
  CHECK(json["texels"] == kInputSize * kInputSize);
  for (const char* kind : {"nan", "infinite", "negative"}) CHECK(json[kind] == 1);
  CHECK(json["specular"] == "out/s.exr");
  CHECK_THAT(kept.errors, Contains("1 texel with NaN; first bad texel: (6, 4)"));
  CHECK(std::isnan(session.image("out/s.exr").at(6, 4, 1)));

  require_success(convert_ward(session, words + "clamp"));
  const TestImage out = session.image("out/s.exr"), r = session.image("r.exr");
  const float edge = static_cast<float>(find_converter("mitsuba/ward", "mitsuba/as").info().specular.max);
  for (const auto& [x, green] : {std::pair{6, 0.0f}, {7, edge}, {8, 0.0f}})
    CHECK(out.at(x, 4, 1) == converted_texel(r.at(x, 4, 0), {0.2f, green, 0.2f})[2]);

  fs::remove_all(session.path("out"));
  const ProcessResult failed = convert_ward(session, words + "fail");
  CHECK(failed.exit_code == 1);
  CHECK_THAT(failed.last_error(),
             Contains("s.exr: G of texel (6, 4) is nan (--nan clamp replaces such values)"));
  CHECK(session.file_count() == 0);
}

TEST_CASE("texremap inputs: the mask marks the texels that were counted") {
  const Session session;
  session.write_pair("exr", kInputSize);
  session.make("r.exr", test_spec(kInputSize, kInputSize, {"Y"}, OIIO::TypeHalf),
               [](int x, int y, int c) { return 1.3f * noise(x, y, c); });
  const ProcessResult result =
      require_success(convert_ward(session, maps("r.exr", "s.exr") + "--json --diagnose checks"));
  const TestImage mask = session.image("checks/mask.exr"), in = session.image("r.exr");
  const Range covered = find_converter("mitsuba/ward", "mitsuba/as").info().roughness;
  std::size_t marked = 0;
  for (int y = 0; y < kInputSize; ++y)
    for (int x = 0; x < kInputSize; ++x) {
      REQUIRE(mask.at(x, y, 0) == (covered.contains(static_cast<double>(in.at(x, y, 0))) ? 0.0f : 1.0f));
      marked += mask.at(x, y, 0) == 1.0f;
    }
  CHECK(marked > 0);
  CHECK(nlohmann::json::parse(result.output)["out_of_domain"] == marked);
}

TEST_CASE("texremap inputs: a converted map is not converted again", "[slow]") {
  const Session session;
  const std::string extension = GENERATE("exr", "tif");
  session.write_pair(extension, kInputSize);
  const std::string r = "r." + extension, s = "s." + extension;
  require_success(session.convert(r, s));
  Words again = maps("out/" + r, "out/" + s);
  again.back() = "again";
  const ProcessResult refused = convert_ward(session, again);
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.last_error(),
             Contains("already converted to mitsuba/as, but would be read as mitsuba/ward"));
  CHECK_FALSE(fs::exists(session.path("again")));
  // Converting the results again is allowed, from their current model.
  CHECK(session.texremap("convert --from mitsuba/as --to mitsuba/ggx" + again).exit_code == 0);
  again.push_back("--force");
  CHECK(convert_ward(session, again).exit_code == 0);
}

TEST_CASE("texremap inputs: grey in a JPEG may be a step from grey") {
  const Session session;
  const auto write = [&](float red) {
    session.make("r.jpg", test_spec(64, 64, {"R", "G", "B"}, OIIO::TypeUInt8),
                 [&](int x, int y, int c) { return 0.7f * noise(x / 8, y / 8, 0) + (c == 0 ? red : 0.0f); });
  };
  const Words words = "--roughness r.jpg --specular 0.5 -o out --force";
  write(1.0f / 255.0f);
  CHECK(convert_ward(session, words).exit_code == 0);
  write(0.2f);
  const ProcessResult refused = convert_ward(session, words);
  CHECK(refused.exit_code == 1);
  CHECK_THAT(refused.last_error(), Contains("is not grey"));
}
