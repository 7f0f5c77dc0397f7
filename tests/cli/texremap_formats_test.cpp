// This file reads the results of texremap with OpenImageIO. Converted channels must equal the converter.
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

constexpr int kWidth = 70, kHeight = 50;

struct Case {
  std::string extension;
  OIIO::TypeDesc type;
  int tile = 0;
  std::string compression;
  std::vector<std::string> channels;
  enum { kPlain, kWindowed, kAssociated } special = kPlain;
};

const std::vector<std::string> kRgbNames = {"R", "G", "B"};
const std::vector<std::string> kRgbaNames = {"R", "G", "B", "A"};
const std::vector<std::string> kWithMask = {"R", "G", "B", "A", "mask"};

std::vector<Case> cases() {
  return {{"exr", OIIO::TypeHalf, 0, "zip", kWithMask},
          {"exr", OIIO::TypeHalf, 32, "piz", kWithMask},
          {"exr", OIIO::TypeFloat, 0, "piz", kWithMask, Case::kWindowed},
          {"exr", OIIO::TypeFloat, 16, "zips", kRgbaNames},
          {"exr", OIIO::TypeHalf, 0, "none", kRgbNames},
          {"tif", OIIO::TypeUInt8, 0, "lzw", kWithMask},
          {"tif", OIIO::TypeUInt16, 32, "zip", kRgbaNames},
          {"tif", OIIO::TypeUInt16, 0, "zip", kRgbaNames, Case::kAssociated},
          {"tif", OIIO::TypeFloat, 0, "zip", kWithMask},
          {"png", OIIO::TypeUInt8, 0, "", kRgbaNames},
          {"png", OIIO::TypeUInt16, 0, "", kRgbaNames},
          {"tga", OIIO::TypeUInt8, 0, "", kRgbaNames},
          {"bmp", OIIO::TypeUInt8, 0, "", kRgbNames}};
}

OIIO::ImageSpec spec_of(const Case& format, const std::vector<std::string>& channels) {
  OIIO::ImageSpec spec = test_spec(kWidth, kHeight, channels, format.type);
  spec.tile_width = spec.tile_height = format.tile;
  if (!format.compression.empty()) spec.attribute("Compression", format.compression);
  if (format.special == Case::kAssociated) spec.erase_attribute("oiio:UnassociatedAlpha");
  if (format.special == Case::kWindowed)
    spec.x = 10, spec.y = -7, spec.full_width = 200, spec.full_height = 100;
  return spec;
}

void check_converted(const TestImage& roughness, const TestImage& specular, const TestImage& roughness_out,
                     const TestImage& specular_out) {
  for (int y = 0; y < specular.spec.height; ++y) {
    for (int x = 0; x < specular.spec.width; ++x) {
      const auto read = [&](int c) { return color_read(specular.at(x, y, c), specular.spec.format); };
      const std::array<float, 4> expected =
          converted_texel(roughness.at(x, y, 0), {read(0), read(1), read(2)});
      REQUIRE(roughness_out.at(x, y, 0) ==
              Approx(as_stored(expected[0], roughness_out.spec.format)).margin(1e-4));
      for (int c = 0; c < 3; ++c) {
        INFO(x << " " << y << " " << c << ": " << specular.at(x, y, c) << " to " << specular_out.at(x, y, c)
               << ", expected "
               << linear_to_srgb(static_cast<double>(expected[static_cast<std::size_t>(c) + 1])));
        REQUIRE(is_color_stored(specular_out.at(x, y, c), expected[static_cast<std::size_t>(c) + 1],
                                specular_out.spec.format));
      }
    }
  }
}

}  // namespace

// texremap_attributes_test compares the storage and all channels that are not converted.
TEST_CASE("texremap: every format is converted in every kind of storage", "[slow]") {
  for (const Case& format : cases()) {
    const Session session;
    const std::string r = "r." + format.extension, s = "s." + format.extension;
    INFO(format.extension << " " << format.type.c_str() << " " << format.compression << " " << format.tile);
    session.make(r, spec_of(format, {"Y"}), noise);
    session.make(s, spec_of(format, format.channels), [](int x, int y, int c) { return noise(x, y, c + 1); });
    const ProcessResult result = require_success(session.convert(r, s));
    const TestImage roughness = session.image(r), specular = session.image(s);
    const TestImage roughness_out = session.image("out/" + r);
    const TestImage specular_out = session.image("out/" + s);
    CHECK(specular_out.spec.channelnames == specular.spec.channelnames);
    check_converted(roughness, specular, roughness_out, specular_out);
    CHECK(session.file_count() == 2);
  }
}

TEST_CASE("texremap: metadata records the conversion") {
  const Session session;
  session.write_pair("exr");
  require_success(session.convert("r.exr", "s.exr", {"--format", GENERATE("exr", "png")}));
  for (const auto& entry : fs::directory_iterator(session.path("out"))) {
    if (entry.path().filename() == kJournal) continue;
    const OIIO::ImageSpec spec = read_image(entry.path()).spec;
    CHECK(spec.get_string_attribute("remap:converter") == "mitsuba_ward_to_mitsuba_as");
    CHECK(spec.get_string_attribute("remap:source") == "mitsuba/ward");
    CHECK(spec.get_string_attribute("remap:target") == "mitsuba/as");
    CHECK(spec.get_string_attribute("remap:version") == REMAP_VERSION);
  }
}

TEST_CASE("texremap: the tag Software records the conversion in formats without custom metadata") {
  const Session session;
  session.write_pair("exr");
  const std::string extension = GENERATE("tif", "jpg");
  require_success(session.convert("r.exr", "s.exr", "--format " + extension));
  const OIIO::ImageSpec spec = session.image("out/s." + extension).spec;
  CHECK_THAT(
      std::string(spec.get_string_attribute("Software")),
      Catch::Matchers::StartsWith("remap:converter=mitsuba_ward_to_mitsuba_as; remap:source=mitsuba/ward; "
                                  "remap:target=mitsuba/as; remap:version=" REMAP_VERSION));
}

TEST_CASE("texremap: another format uses its least lossy type") {
  const Session session;
  const std::string extension = GENERATE("png", "tif", "exr");
  session.write_pair("exr", 64, OIIO::TypeHalf);
  require_success(session.convert("r.exr", "s.exr", "--format " + extension));
  const TestImage out = session.image("out/s." + extension);
  CHECK(out.spec.format == (extension == "png"   ? OIIO::TypeUInt16
                            : extension == "tif" ? OIIO::TypeFloat
                                                 : OIIO::TypeHalf));
  check_converted(session.image("r.exr"), session.image("s.exr"), session.image("out/r." + extension), out);
}

TEST_CASE("texremap: --type chooses the pixel type, and clipped values are counted") {
  const Session session;
  session.make("r.exr", test_spec(64, 64, {"Y"}, OIIO::TypeFloat), noise);
  session.make("s.exr", test_spec(64, 64, kRgbNames, OIIO::TypeFloat),
               [](int x, int y, int c) { return x == 5 && y == 6 ? 9.0f : 0.3f * noise(x, y, c); });
  const ProcessResult result =
      require_success(session.convert("r.exr", "s.exr", "--format tif --type uint8"));
  CHECK_THAT(result.errors, Contains("3 values clipped to 0 or 1"));
  const TestImage out = session.image("out/s.tif");
  CHECK(out.spec.format == OIIO::TypeUInt8);
  check_converted(session.image("r.exr"), session.image("s.exr"), session.image("out/r.tif"), out);
}

TEST_CASE("texremap: --compression changes sizes and no texel", "[slow]") {
  const Session session;
  for (const std::string extension : {"png", "tif", "exr"}) {
    session.write_pair(extension);
    const std::string roughness = "r." + extension, specular = "s." + extension;
    std::uintmax_t last = std::numeric_limits<std::uintmax_t>::max();
    std::vector<float> texels;
    for (const std::string level : {"1", "9"}) {
      require_success(
          session.convert(roughness, specular, "--force --format " + extension + " --compression " + level));
      const std::uintmax_t size = fs::file_size(session.path("out/" + specular));
      INFO(extension << " " << level);
      // A PNG of noise cannot get smaller, so its size may stay the same.
      CHECK((extension == "png" ? size <= last : size < last));
      last = size;
      const std::vector<float> now = session.image("out/" + specular).values;
      if (!texels.empty()) CHECK(now == texels);
      texels = now;
    }
  }
}

TEST_CASE("texremap: a constant becomes a map of the same size") {
  const Session session;
  session.write_pair("exr");
  const std::string constant = GENERATE("0.5", "0.9,0.6,0.2");
  require_success(session.convert("r.exr", constant));
  const TestImage in = session.image("r.exr"), out = session.image("out/specular.exr");
  CHECK(out.spec.width == 64);
  CHECK(out.spec.channelnames == (constant == "0.5" ? std::vector<std::string>{"Y"} : kRgbNames));
  const std::array<float, 3> specular =
      constant == "0.5" ? std::array{0.5f, 0.5f, 0.5f} : std::array{0.9f, 0.6f, 0.2f};
  for (int x = 0; x < 64; ++x) {
    const std::array<float, 4> expected = converted_texel(in.at(x, 9, 0), specular);
    for (int c = 0; c < out.spec.nchannels; ++c)
      CHECK(out.at(x, 9, c) == as_stored(expected[static_cast<std::size_t>(c) + 1], OIIO::TypeHalf));
  }
  require_success(session.convert("0.3", "s.exr"));
  const TestImage colors = session.image("s.exr"), roughness = session.image("out/roughness.exr");
  CHECK(roughness.spec.channelnames == std::vector<std::string>{"Y"});
  for (int x = 0; x < 64; ++x)
    CHECK(roughness.at(x, 2, 0) ==
          as_stored(converted_texel(0.3f, {colors.at(x, 2, 0), colors.at(x, 2, 1), colors.at(x, 2, 2)})[0],
                    OIIO::TypeHalf));
}

TEST_CASE("texremap: a JPEG stays one, with a warning") {
  const Session session;
  session.write_pair("jpg", 64, OIIO::TypeUInt8);
  const ProcessResult result = require_success(session.convert("r.jpg", "s.jpg"));
  CHECK_THAT(result.errors, Contains("jpeg compression changes values") && Contains("specular read as srgb"));
  const TestImage in = session.image("r.jpg"), color = session.image("s.jpg"),
                  out = session.image("out/r.jpg");
  // JPEG of quality 100 rounds the coefficients of 8 x 8 cosines to integers. The error is at most a few
  // steps of 1/255.
  for (int x = 0; x < 64; ++x) {
    const auto read = [&](int c) { return color_read(color.at(x, 3, c), color.spec.format); };
    const std::array<float, 3> specular = {read(0), read(1), read(2)};
    CHECK(out.at(x, 3, 0) == Approx(converted_texel(in.at(x, 3, 0), specular)[0]).margin(4.0 / 255.0));
  }
}

TEST_CASE("texremap formats: a large Targa is clamped in memory, with a remark", "[slow]") {
  const Session session;
  for (const int height : {16, 3000}) {
    const std::string name = "s" + std::to_string(height) + ".tga";
    OIIO::ImageSpec spec = test_spec(8000, height, {"R", "G", "B"}, OIIO::TypeUInt8);
    spec.attribute("Compression", "rle");
    session.make(name, spec, [](int, int, int) { return 0.5f; });
    const ProcessResult result =
        session.texremap("convert --from mitsuba/ward --to mitsuba/as --roughness 0.3 --specular " + name +
                         " --only specular -o out");
    REQUIRE(result.exit_code == 0);
    CHECK((result.errors.find("the whole Targa image is clamped in memory (68 MB)") != std::string::npos) ==
          (height == 3000));
  }
}
