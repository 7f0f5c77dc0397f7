// Layouts: results packed into one file, split into several, and packed again.
#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

constexpr int kSize = 48;

ProcessResult convert(const Session& session, const std::string& from, const std::string& to,
                      std::vector<std::string> words, const std::string& folder) {
  words.insert(words.begin(), {"convert", "--from", from, "--to", to});
  words.insert(words.end(), {"-o", session.path(folder)});
  return session.texremap(words);
}

std::vector<float> channel(const Session& session, const std::string& name, int index) {
  const TestImage image = read_image(session.path(name));
  std::vector<float> values;
  for (int y = 0; y < image.spec.height; ++y)
    for (int x = 0; x < image.spec.width; ++x) values.push_back(image.at(x, y, index));
  return values;
}

std::vector<std::string> packed(const Session& session, const std::string& name) {
  const std::string path = session.path(name);
  return {"--roughness", path + ":G", "--occlusion", path + ":R",
          "--metallic",  path + ":B", "--specular",  "0.4"};
}

}  // namespace

TEST_CASE("texremap layouts: a packed map taken apart and packed again", "[slow]") {
  const Session session;
  const std::string extension = GENERATE("png", "tif", "exr", "tga");
  const OIIO::TypeDesc type = extension == "exr" ? OIIO::TypeHalf : OIIO::TypeUInt8;
  const auto named = [&](const std::string& name) { return name + "." + extension; };
  write_image(session.path(named("in")), test_spec(kSize, kSize, {"R", "G", "B"}, type), noise);
  std::vector<std::string> words = packed(session, named("in"));
  words.insert(words.end(), {"--layout", "separate"});
  require_success(convert(session, "mitsuba/ward", "mitsuba/as", words, "apart"));
  CHECK(channel(session, named("apart/occlusion"), 0) == channel(session, named("in"), 0));
  CHECK(channel(session, named("apart/metallic"), 0) == channel(session, named("in"), 2));
  const std::vector<float> given = channel(session, named("in"), 1);
  std::vector<float> expected;
  for (const float alpha : given)
    expected.push_back(as_stored(converted_texel(alpha, {0.4f, 0.4f, 0.4f})[0], type));
  CHECK(channel(session, named("apart/roughness"), 0) == expected);
  CHECK(read_image(session.path(named("apart/roughness"))).spec.format == type);

  // Packed again and converted to another model; then as-inputs, which keeps the layout.
  const std::string layout = GENERATE("orm", "arm");
  require_success(convert(session, "mitsuba/as", "mitsuba/ggx",
                          {"--roughness", session.path(named("apart/roughness")), "--occlusion",
                           session.path(named("apart/occlusion")), "--metallic",
                           session.path(named("apart/metallic")), "--specular", "0.4", "--layout", layout},
                          "packed"));
  CHECK(channel(session, named("packed/" + layout), 0) == channel(session, named("in"), 0));
  CHECK(channel(session, named("packed/" + layout), 2) == channel(session, named("in"), 2));
  require_success(convert(session, "mitsuba/as", "mitsuba/ggx",
                          {"--roughness", session.path(named("apart/roughness")), "--specular", "0.4"},
                          "plain"));
  CHECK(channel(session, named("packed/" + layout), 1) == channel(session, named("plain/roughness"), 0));
}

TEST_CASE("texremap layouts: specular and glossiness in one file, grey in every color", "[slow]") {
  const Session session;
  const std::string extension = GENERATE("png", "tif", "exr", "tga");
  const auto named = [&](const std::string& name) { return name + "." + extension; };
  write_image(session.path(named("r")), test_spec(kSize, kSize, {"Y"}, OIIO::TypeUInt8), noise);
  write_image(session.path(named("s")), test_spec(kSize, kSize, {"R", "G", "B"}, OIIO::TypeUInt8),
              [](int x, int y, int c) { return noise(x, y, c + 1); });
  const bool grey = GENERATE(false, true);
  require_success(convert(session, "mitsuba/ward", "mitsuba/as",
                          {"--roughness", session.path(named("r")), "--specular",
                           grey ? "0.3" : session.path(named("s")), "--layout", "specgloss"},
                          "out"));
  const TestImage r = read_image(session.path(named("r"))), s = read_image(session.path(named("s"))),
                  out = read_image(session.path(named("out/specular_glossiness")));
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
  write_image(session.path("r.png"), test_spec(kSize, kSize, {"Y"}, OIIO::TypeUInt8), noise);
  const ProcessResult result = require_success(
      convert(session, "mitsuba/ward", "mitsuba/as",
              {"--roughness", session.path("r.png"), "--specular", "0.4", "--layout", "orm"}, "out"));
  CHECK_THAT(result.errors, Contains("no occlusion map; occlusion is set to 1") &&
                                Contains("no metallic map; metallic is set to 0"));
  CHECK(channel(session, "out/orm.png", 0) == std::vector<float>(kSize * kSize, 1.0f));
  CHECK(channel(session, "out/orm.png", 2) == std::vector<float>(kSize * kSize, 0.0f));
}
