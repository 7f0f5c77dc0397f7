// Layouts: results packed into one file, split into several, and packed again.
#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

constexpr int kSize = 48;

ProcessResult convert(const Session& session, const std::string& from, const std::string& to, Words words,
                      const std::string& folder) {
  return session.texremap(Words("convert --from " + from + " --to " + to) + words + "-o " + folder);
}

std::vector<float> channel(const Session& session, const std::string& name, int index) {
  const TestImage image = session.image(name);
  std::vector<float> values;
  for (int y = 0; y < image.spec.height; ++y)
    for (int x = 0; x < image.spec.width; ++x) values.push_back(image.at(x, y, index));
  return values;
}

Words packed(const std::string& path) {
  return "--roughness " + path + ":G --occlusion " + path + ":R --metallic " + path + ":B --specular 0.4";
}

}  // namespace

TEST_CASE("texremap layouts: a packed map taken apart and packed again", "[slow]") {
  const Session session;
  const std::string extension = GENERATE("png", "tif", "exr", "tga");
  const OIIO::TypeDesc type = extension == "exr" ? OIIO::TypeHalf : OIIO::TypeUInt8;
  const auto named = [&](const std::string& name) { return name + "." + extension; };
  session.make(named("in"), test_spec(kSize, kSize, {"R", "G", "B"}, type), noise);
  Words words = packed(named("in"));
  words += "--layout separate";
  require_success(convert(session, "mitsuba/ward", "mitsuba/as", words, "apart"));
  CHECK(channel(session, named("apart/occlusion"), 0) == channel(session, named("in"), 0));
  CHECK(channel(session, named("apart/metallic"), 0) == channel(session, named("in"), 2));
  const std::vector<float> given = channel(session, named("in"), 1);
  std::vector<float> expected;
  for (const float alpha : given)
    expected.push_back(as_stored(converted_texel(alpha, {0.4f, 0.4f, 0.4f})[0], type));
  CHECK(channel(session, named("apart/roughness"), 0) == expected);
  CHECK(session.image(named("apart/roughness")).spec.format == type);

  // Packed again and converted to another model; then as-inputs, which keeps the layout.
  const std::string layout = GENERATE("orm", "arm");
  require_success(convert(session, "mitsuba/as", "mitsuba/ggx",
                          "--roughness " + named("apart/roughness") + " --occlusion " +
                              named("apart/occlusion") + " --metallic " + named("apart/metallic") +
                              " --specular 0.4 --layout " + layout,
                          "packed"));
  CHECK(channel(session, named("packed/" + layout), 0) == channel(session, named("in"), 0));
  CHECK(channel(session, named("packed/" + layout), 2) == channel(session, named("in"), 2));
  require_success(convert(session, "mitsuba/as", "mitsuba/ggx",
                          "--roughness " + named("apart/roughness") + " --specular 0.4", "plain"));
  CHECK(channel(session, named("packed/" + layout), 1) == channel(session, named("plain/roughness"), 0));
}

TEST_CASE("texremap layouts: specular and glossiness in one file, grey in every color", "[slow]") {
  const Session session;
  const std::string extension = GENERATE("png", "tif", "exr", "tga");
  const auto named = [&](const std::string& name) { return name + "." + extension; };
  session.make(named("r"), test_spec(kSize, kSize, {"Y"}, OIIO::TypeUInt8), noise);
  session.make(named("s"), test_spec(kSize, kSize, {"R", "G", "B"}, OIIO::TypeUInt8),
               [](int x, int y, int c) { return noise(x, y, c + 1); });
  const bool grey = GENERATE(false, true);
  require_success(convert(
      session, "mitsuba/ward", "mitsuba/as",
      "--roughness " + named("r") + " --specular " + (grey ? "0.3" : named("s")) + " --layout specgloss",
      "out"));
  const TestImage r = session.image(named("r")), s = session.image(named("s")),
                  out = session.image(named("out/specular_glossiness"));
  CHECK(out.spec.channelnames == std::vector<std::string>{"R", "G", "B", "A"});
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const std::array<float, 3> specular = grey ? std::array{0.3f, 0.3f, 0.3f}
                                                 : std::array{color_read(s.at(x, y, 0), s.spec.format),
                                                              color_read(s.at(x, y, 1), s.spec.format),
                                                              color_read(s.at(x, y, 2), s.spec.format)};
      const auto expected = converted_texel(r.at(x, y, 0), specular);
      for (int c = 0; c < 3; ++c)
        REQUIRE(is_color_stored(out.at(x, y, c), expected[static_cast<std::size_t>(c) + 1], out.spec.format));
      REQUIRE(out.at(x, y, 3) == Approx(1.0f - std::sqrt(expected[0])).margin(0.501 / 255.0));
    }
}

TEST_CASE("texremap layouts: missing maps give a warning") {
  const Session session;
  session.make("r.png", test_spec(kSize, kSize, {"Y"}, OIIO::TypeUInt8), noise);
  const ProcessResult result = require_success(
      convert(session, "mitsuba/ward", "mitsuba/as", "--roughness r.png --specular 0.4 --layout orm", "out"));
  CHECK_THAT(result.errors, Contains("no occlusion map; occlusion is set to 1") &&
                                Contains("no metallic map; metallic is set to 0"));
  CHECK(channel(session, "out/orm.png", 0) == std::vector<float>(kSize * kSize, 1.0f));
  CHECK(channel(session, "out/orm.png", 2) == std::vector<float>(kSize * kSize, 0.0f));
}
