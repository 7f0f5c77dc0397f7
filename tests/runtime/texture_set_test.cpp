// Which channels of which files a converter gets.
#include "texture/texture_set.hpp"

#include <OpenImageIO/imagebufalgo.h>
#include <catch2/catch.hpp>

#include "error.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_image.hpp"

using namespace remap;
using Catch::Matchers::Contains;

namespace {

struct Files {
  TemporaryFolder folder;

  std::filesystem::path image(const std::string& name, const std::vector<std::string>& channels,
                              int width = 4, int height = 3) const {
    const auto path = folder.path() / name;
    write_image(path, test_spec(width, height, channels, OIIO::TypeHalf), noise);
    return path;
  }
};

std::vector<std::size_t> roughness_channels(const TextureSetRequest& request) {
  return open_texture_set(request).roughness.channels;
}

}  // namespace

TEST_CASE("texture set: numbers are a constant specular, anything else a file") {
  CHECK(std::get<ConstantSpecular>(specular_source("0.5")) == ConstantSpecular{0.5f});
  CHECK(std::get<ConstantSpecular>(specular_source("0.9,0.6,0.2")) == ConstantSpecular{0.9f, 0.6f, 0.2f});
  CHECK(std::get<std::filesystem::path>(specular_source("0.5.exr")) == "0.5.exr");
  CHECK(std::get<std::filesystem::path>(specular_source("a,b.exr")) == "a,b.exr");
  CHECK(std::get<std::filesystem::path>(specular_source("")) == "");
  for (const char* bad : {"0.5,0.5", "-1", "1,2,3,4", "inf", "nan"})
    CHECK_THROWS_AS(specular_source(bad), Error);
}

TEST_CASE("texture set: the roughness is the only channel, Y, or equal colours") {
  const Files files;
  const ConstantSpecular grey = {0.5f};
  CHECK(roughness_channels({files.image("1.exr", {"width"}), grey, {}}) == std::vector<std::size_t>{0});
  CHECK(roughness_channels({files.image("2.exr", {"Y", "A"}), grey, {}}) == std::vector<std::size_t>{0});
  CHECK(roughness_channels({files.image("3.exr", {"r", "g", "b"}), grey, {}}) ==
        std::vector<std::size_t>{0, 1, 2});
  CHECK(roughness_channels({files.image("4.exr", {"R", "G", "B"}), grey, "G"}) ==
        std::vector<std::size_t>{1});
  CHECK(open_texture_set({files.image("5.exr", {"R", "G", "B"}), grey, {}}).roughness.copies);
}

TEST_CASE("texture set: a missing channel is answered with those that are there") {
  const Files files;
  const auto odd = files.image("odd.exr", {"first", "second"});
  const auto plain = files.image("plain.exr", {"Y"});
  CHECK_THROWS_WITH(open_texture_set({odd, ConstantSpecular{0.5f}, {}}),
                    Contains("has the channels first, second") && Contains("--roughness-channel"));
  CHECK_THROWS_WITH(open_texture_set({plain, odd, {}}),
                    Contains("odd.exr: has the channels first, second; expected R, G and B"));
  CHECK_THROWS_WITH(open_texture_set({odd, ConstantSpecular{0.5f}, "secand"}),
                    Contains("did you mean second?"));
}

TEST_CASE("texture set: maps of different size are refused with both sizes") {
  const Files files;
  CHECK_THROWS_WITH(
      open_texture_set({files.image("r.exr", {"Y"}, 4, 3), files.image("s.exr", {"R", "G", "B"}, 8, 6), {}}),
      Contains("8 x 6") && Contains("4 x 3"));
}

TEST_CASE("texture set: an integer specular map tagged sRGB is a doubt, a float one is none") {
  const Files files;
  auto spec = test_spec(4, 3, {"R", "G", "B"}, OIIO::TypeUInt8);
  const auto png = files.folder.path() / "s.png";
  spec.attribute("oiio:ColorSpace", "sRGB");
  write_image(png, spec, noise);
  const auto roughness = files.image("r.exr", {"Y"});
  const TextureSet tagged = open_texture_set({roughness, png, {}});
  REQUIRE(doubts(tagged).size() == 1);
  CHECK_THAT(doubts(tagged).front(), Contains("read as linear"));
  CHECK(doubts(open_texture_set({roughness, files.image("s.exr", {"R", "G", "B"}), {}})).empty());
}

TEST_CASE("image reader: parts, mip levels and folders are refused with the reason") {
  const Files files;
  CHECK_THROWS_WITH(ImageReader(files.folder.path()), Contains("is a folder"));
  const auto parts = files.folder.path() / "parts.exr";
  const auto spec = test_spec(4, 4, {"Y"}, OIIO::TypeHalf);
  const std::vector<OIIO::ImageSpec> specs = {spec, spec};
  const std::vector<float> values(16, 0.5f);
  auto output = OIIO::ImageOutput::create(parts.string());
  REQUIRE(output->open(parts.string(), 2, specs.data()));
  REQUIRE(output->write_image(OIIO::TypeFloat, values.data()));
  REQUIRE(output->open(parts.string(), spec, OIIO::ImageOutput::AppendSubimage));
  REQUIRE(output->write_image(OIIO::TypeFloat, values.data()));
  REQUIRE(output->close());
  CHECK_THROWS_WITH(ImageReader(parts), Contains("has more than one part; expected one"));

  const auto levels = files.folder.path() / "levels.exr";
  const auto plain = files.image("plain.exr", {"Y"}, 32, 32);
  REQUIRE(OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, plain.string(), levels.string(),
                                           OIIO::ImageSpec()));
  CHECK_THROWS_WITH(ImageReader(levels), Contains("has mip levels; expected one level"));
}
