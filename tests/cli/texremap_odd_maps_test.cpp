// This file tests maps of unusual sizes, and maps with too few or too many channels.
#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

OIIO::TypeDesc type_in(const std::string& extension) {
  return extension == "exr" ? OIIO::TypeHalf : extension == "hdr" ? OIIO::TypeFloat : OIIO::TypeUInt8;
}

}  // namespace

TEST_CASE("texremap odd maps: one texel, and strips, in every format", "[slow]") {
  const Session session;
  const std::string extension = GENERATE("exr", "tif", "png", "tga", "bmp", "jpg", "hdr");
  const int longest = extension == "exr" || extension == "tif" || extension == "png" ? 100000 : 32000;
  for (const auto& [width, height] : {std::pair{1, 1}, {1, longest}, {longest, 1}}) {
    INFO(extension << ", " << width << " x " << height);
    const std::string name = "s." + extension;
    session.make(name, test_spec(width, height, {"R", "G", "B"}, type_in(extension)), noise);
    const ProcessResult result =
        require_success(session.convert("0.3", name, "--only specular --color-space linear"));
    const TestImage in = session.image(name), out = session.image("out/" + name);
    REQUIRE(out.spec.width == width);
    REQUIRE(out.spec.height == height);
    const int x = width - 1, y = height - 1;  // the last texel
    const auto expected = converted_texel(0.3f, {in.at(x, y, 0), in.at(x, y, 1), in.at(x, y, 2)});
    // Values must be exact, except for a step of JPEG and the shared exponent of Radiance (8 bits of the
    // largest channel).
    const double step = extension == "jpg" ? 6.0 / 255.0 : extension == "hdr" ? 1.0 / 128.0 : 0.0;
    for (int c = 0; c < 3; ++c)
      CHECK(static_cast<double>(out.at(x, y, c)) ==
            Approx(static_cast<double>(as_stored(expected[static_cast<std::size_t>(c) + 1], out.spec.format)))
                .margin(step));
    fs::remove_all(session.path("out"));
  }
}

TEST_CASE("texremap odd maps: one to five channels where three are expected", "[slow]") {
  const Session session;
  const std::string extension = GENERATE("exr", "tif", "png");
  const std::vector<std::string> names = {"R", "G", "B", "A", "mask"};
  for (int count = 1; count <= (extension == "png" ? 4 : 5); ++count) {
    INFO(extension << ", " << count << " channels");
    const std::string name = "s." + extension;
    std::vector<std::string> channels(names.begin(), names.begin() + count);
    if (count == 1) channels = {"Y"};
    session.make(name, test_spec(16, 16, channels, type_in(extension)), noise);
    const ProcessResult result = session.convert("0.3", name, "--only specular --color-space linear");
    INFO(result.errors);
    if (count == 2 && extension != "png") {  // a PNG with two channels is grey with alpha
      CHECK(result.exit_code == 1);
      CHECK_THAT(result.last_error(), Contains(name + ": has the channels R, G, but needs R, G and B"));
      continue;
    }
    REQUIRE(result.exit_code == 0);
    const TestImage in = session.image(name), out = session.image("out/" + name);
    REQUIRE(out.spec.nchannels == count);
    for (int c = 0; c < count; ++c) {
      const float value = in.at(5, 7, c);
      const bool is_color = c < 3 && (count != 2 || c == 0);
      const float expected = converted_texel(0.3f, {value, value, value})[1];
      CHECK(out.at(5, 7, c) == (is_color ? as_stored(expected, out.spec.format) : value));
    }
    fs::remove_all(session.path("out"));
  }
}
