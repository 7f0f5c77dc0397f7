// This file reads the results of texremap with OpenImageIO: every format, unusual sizes and numbers of
// channels, and maps of different sizes. Converted channels must equal the converter. The resampling of
// OpenImageIO is the reference for values between texels.
#include <cmath>
#include <limits>

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
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

const std::vector<std::string> kWithMask = {"R", "G", "B", "A", "mask"};

std::vector<Case> cases() {
  return {{"exr", OIIO::TypeHalf, 0, "zip", kWithMask},
          {"exr", OIIO::TypeHalf, 32, "piz", kWithMask},
          {"exr", OIIO::TypeFloat, 0, "piz", kWithMask, Case::kWindowed},
          {"exr", OIIO::TypeFloat, 16, "zips", kWithAlpha},
          {"exr", OIIO::TypeHalf, 0, "none", kColor},
          {"tif", OIIO::TypeUInt8, 0, "lzw", kWithMask},
          {"tif", OIIO::TypeUInt16, 32, "zip", kWithAlpha},
          {"tif", OIIO::TypeUInt16, 0, "zip", kWithAlpha, Case::kAssociated},
          {"tif", OIIO::TypeFloat, 0, "zip", kWithMask},
          {"png", OIIO::TypeUInt8, 0, "", kWithAlpha},
          {"png", OIIO::TypeUInt16, 0, "", kWithAlpha},
          {"tga", OIIO::TypeUInt8, 0, "", kWithAlpha},
          {"bmp", OIIO::TypeUInt8, 0, "", kColor}};
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
  session.map("r.exr", kGrey, OIIO::TypeFloat);
  const auto bright = [](int x, int y, int c) { return x == 5 && y == 6 ? 9.0f : 0.3f * noise(x, y, c); };
  session.map("s.exr", kColor, bright, OIIO::TypeFloat);
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
  CHECK(out.spec.channelnames == (constant == "0.5" ? Names{"Y"} : kColor));
  const std::array<float, 3> specular =
      constant == "0.5" ? std::array{0.5f, 0.5f, 0.5f} : std::array{0.9f, 0.6f, 0.2f};
  for (int x = 0; x < 64; ++x) {
    const std::array<float, 4> expected = converted_texel(in.at(x, 9, 0), specular);
    for (int c = 0; c < out.spec.nchannels; ++c)
      CHECK(out.at(x, 9, c) == as_stored(expected[static_cast<std::size_t>(c) + 1], OIIO::TypeHalf));
  }
  require_success(session.convert("0.3", "s.exr"));
  const TestImage colors = session.image("s.exr"), roughness = session.image("out/roughness.exr");
  CHECK(roughness.spec.channelnames == Names{"Y"});
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
    const Names channels = count == 1 ? kGrey : Names(names.begin(), names.begin() + count);
    session.map(name, channels, type_in(extension));
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

namespace {

// Converts the maps of a command into the folder `out`, or into another one.
ProcessResult resampled(const Session& session, const Words& words, const std::string& folder = "out") {
  return require_success(
      session.texremap("convert --from mitsuba/ward --to mitsuba/as" + words + "-o " + folder));
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
      resampled(session, "--roughness r.exr --specular s.exr --resample --threads 1");
  CHECK_THAT(result.errors, Contains("s.exr: resampled to " + std::to_string(large) + "x"));
  resampled(session, "--roughness r.exr --specular s_large.exr", "expected");
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
  resampled(session, "--roughness r.png --specular s.png --resample --only roughness");
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
  resampled(session, "--roughness r.png --specular s.png --color-space srgb --resample");
  const TestImage out = session.image("out/s.png");
  // The texel is a quarter of the way from black to white, in linear light.
  const float linear = converted_texel(as_stored(0.3f, OIIO::TypeUInt8), {0.25f, 0.25f, 0.25f})[1];
  const double stored = linear_to_srgb(static_cast<double>(linear));
  CHECK(out.at(1, 0, 0) == as_stored(static_cast<float>(stored), OIIO::TypeUInt8));
}

TEST_CASE("texremap --resample: all channels of a packed roughness map are resampled") {
  const Session session;
  session.map("orm.png", kColor, OIIO::TypeUInt8, 20);
  session.map("s.png", kGrey, OIIO::TypeUInt8, 40);
  write_resampled(session, "orm.png", 40, 40, "orm_large.tif");
  resampled(session, "--roughness orm.png:G --specular s.png --resample");
  const TestImage out = session.image("out/orm.png"), expected = session.image("orm_large.tif");
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x)
      REQUIRE(std::fabs(out.at(x, y, 0) - expected.at(x, y, 0)) <= 0.501f / 255.0f);
}
