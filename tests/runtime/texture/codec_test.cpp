// This file tests images in memory, as assets embed or refer to them, in each format that is supported.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "core/errors.hpp"
#include "core/input_file.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_image.hpp"
#include "texture/image_library.hpp"

using namespace remap;

namespace {

constexpr int kAcross = 13, kDown = 7;

std::string image_bytes(const std::string& extension, const std::vector<std::string>& channels) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / ("image." + extension);
  OIIO::ImageSpec spec = test_spec(kAcross, kDown, channels, OIIO::TypeUInt8);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  write_image(file, spec, noise);
  return read_file(file);
}

}  // namespace

TEST_CASE("The codec reads the formats of assets as they are stored", "[texture]") {
  for (const std::string extension : {"png", "tga", "bmp", "tif"})
    for (const bool has_alpha : {false, true}) {
      if (extension == "bmp" && has_alpha) continue;  // OpenImageIO cannot write this
      const std::vector<std::string> channels =
          has_alpha ? std::vector<std::string>{"R", "G", "B", "A"} : std::vector<std::string>{"R", "G", "B"};
      const std::string bytes = image_bytes(extension, channels);
      const ImagePixels pixels = image_library().codec().decode(bytes, "image");
      INFO(extension);
      REQUIRE(pixels.width == kAcross);
      REQUIRE(pixels.height == kDown);
      REQUIRE(pixels.channels == channels.size());
      bool is_same = true;
      for (std::size_t i = 0; i < pixels.bytes.size(); ++i) {
        const auto texel = static_cast<int>(i / pixels.channels), c = static_cast<int>(i % pixels.channels);
        const float value = noise(texel % kAcross, texel / kAcross, c);
        is_same = is_same && std::to_integer<long>(pixels.bytes[i]) == std::lround(value * 255.0f);
      }
      CHECK(is_same);
    }
}

// libwebp's encoder writes this WebP lossless and exact, so colors of opacity 0 are kept.
TEST_CASE("The codec reads WebP as it is stored, colors where nothing is seen among them", "[texture]") {
  const std::string head("RIFF\x34\0\0\0WEBPVP8L\x27\0\0\0\x2f\x02\0\0\0", 25),
      head_of_alpha("RIFF\x38\0\0\0WEBPVP8L\x2b\0\0\0\x2f\x02\0\0\x10", 25),
      colors("\x17\x20\x20\x49\xc0\x5d\xed\x6f\xa3\x98\x34\x61\xa7\xfd\x8b\x1a\x81\x40\x80\x32\x56\xcc\x70",
             23),
      end("\xc5\xfc\x07\x7d\xd3\x87\x26\x44\xf4\x3f\0\0", 12),
      end_of_alpha("\x85\x80\x24\xc1\xe7\x3d\x2f\xe8\x37\xfd\xd0\x84\x88\xfe\x07\0", 16);
  const auto texels = [](const std::string& bytes) {
    const ImagePixels pixels = image_library().codec().decode(bytes, "image");
    std::vector<int> values = {static_cast<int>(pixels.width), static_cast<int>(pixels.channels)};
    for (const std::byte byte : pixels.bytes) values.push_back(std::to_integer<int>(byte));
    return values;
  };
  CHECK(texels(head + colors + end) == std::vector<int>{3, 3, 10, 200, 30, 250, 4, 90, 1, 2, 3});
  CHECK(texels(head_of_alpha + colors + end_of_alpha) ==
        std::vector<int>{3, 4, 10, 200, 30, 0, 250, 4, 90, 128, 1, 2, 3, 255});
  CHECK_THROWS_WITH(texels((head + colors).substr(0, 44)),
                    "image: cannot be read: the image is damaged, or an animation (convert it to PNG)");
}

TEST_CASE("The codec refuses images of a few bytes that claim more texels than these can hold", "[texture]") {
  const std::string bytes("RIFF\x16\0\0\0WEBPVP8L\x0a\0\0\0\x2f\xfe\xbf\xff\x0f\0\0\0\0\0", 30);
  CHECK_THROWS_WITH(image_library().codec().decode(bytes, "image"),
                    "image: is damaged: its size of 16383x16383 is too large for a file of 30 bytes");
  // This BMP has run lengths. OpenImageIO reads it whole when it opens it.
  std::string bmp("BM\x3a\x04\0\0\0\0\0\0\x36\x04\0\0\x28\0\0\0", 18);
  bmp += std::string("\x40\x9c\0\0\x40\x9c\0\0\x01\0\x08\0\x01\0\0\0", 16) + std::string(20 + 1024, '\0') +
         std::string("\x02\x05\0\x01", 4);
  CHECK_THROWS_WITH(image_library().codec().decode(bmp, "image"),
                    "image: is damaged: its size of 40000x40000 is too large for a file of 1082 bytes");
  bmp.replace(18, 8, "\xff\xff\xff\x7f\xff\xff\xff\x7f");
  CHECK_THROWS_WITH(
      image_library().codec().decode(bmp, "image"),
      Catch::Contains("has 2147483647x2147483647 texels, which is more than texremap can read"));
}

TEST_CASE("The codec refuses Targa files with colors behind the end of their palette", "[texture]") {
  const auto targa = [](char type, char bits, const std::string& indices) {
    const std::string begin{0, 1, type, 0, 0, 2, 0, 24, 0, 0, 0, 0, 3, 0, 1, 0, bits, 0};
    return begin + std::string("\1\2\3\11\12\13", 6) + indices;
  };
  const auto decode = [](const std::string& bytes) { return image_library().codec().decode(bytes, "image"); };
  const std::string behind =
      "image: is damaged: a texel has a color behind the end of the palette, which has 2 colors";
  CHECK(decode(targa(1, 8, {1, 0, 1})).width == 3);
  CHECK_THROWS_WITH(decode(targa(1, 8, {1, 0, 2})), behind);
  CHECK_THROWS_WITH(decode(targa(1, 16, {1, 0, 0, 0, 1, 1})), behind);
  // In this Targa, a run repeats one color, or lists as many colors as its length states.
  CHECK(decode(targa(9, 8, std::string("\x81\1\0\0", 4))).width == 3);
  CHECK_THROWS_WITH(decode(targa(9, 8, std::string("\x82\2", 2))), behind);
  CHECK_THROWS_WITH(decode(targa(9, 8, std::string("\2\1\0\2", 4))), behind);
  CHECK_THROWS_WITH(decode(targa(1, 24, std::string(9, '\0'))),
                    "image: has a palette of an unknown kind (convert it to PNG)");
}

TEST_CASE("The codec refuses images that are cut off, and other files", "[texture]") {
  const ImageCodec& codec = image_library().codec();
  for (const std::string extension : {"png", "tga", "bmp", "tif"}) {
    const std::string bytes = image_bytes(extension, {"R", "G", "B"});
    INFO(extension);
    CHECK_THROWS_AS(codec.decode(bytes.substr(0, std::min<std::size_t>(bytes.size() / 2, 200)), "image"),
                    Error);
    CHECK_THROWS_AS(codec.decode(bytes.substr(0, 20), "image"), Error);
  }
  for (const std::string& bytes :
       {std::string(), std::string("BM"), std::string("some text of some length"), std::string(40, '\0')})
    CHECK_THROWS_AS(codec.decode(bytes, "image"), Error);
}
