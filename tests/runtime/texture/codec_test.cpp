// Images in memory as assets embed or name them, in each format that is read.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "core/errors.hpp"
#include "core/read_file.hpp"
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
      if (extension == "bmp" && has_alpha) continue;  // OpenImageIO writes none
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
