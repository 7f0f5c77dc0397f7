// This file tests how channels and files are chosen for the parameters of a converter.
#include "texture/texture_set.hpp"

#include <ctime>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <sys/resource.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "remap/error.hpp"
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

using Source = std::variant<MapName, ConstantValues>;

const Source kGrey = ConstantValues{0.5f};

TextureSet opened(Source roughness, Source specular) {
  TextureSetRequest request;
  request.parameters[Parameter::kRoughness].source = std::move(roughness);
  request.parameters[Parameter::kSpecular].source = std::move(specular);
  return open_texture_set(request);
}

std::vector<std::size_t> roughness_channels(const std::filesystem::path& file,
                                            const std::vector<std::string>& names = {}) {
  std::vector<std::size_t> channels;
  const TextureSet set = opened(MapName{file, names}, kGrey);
  for (const ChannelPlace& place : set.parameters.at(Parameter::kRoughness).channels)
    channels.push_back(place.channel);
  return channels;
}

// Returns a TIFF file whose parts have one grey texel each.
std::string tiff_of_parts(std::uint32_t count) {
  std::string bytes("II*\0\x8\0\0\0", 8);
  const auto add = [&](std::uint32_t number, int size) {
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(number >> 8 * i & 0xffu);
  };
  constexpr std::uint32_t kTags[][2] = {{256, 1}, {257, 1}, {258, 8}, {259, 1}, {262, 1},
                                        {273, 4}, {277, 1}, {278, 1}, {279, 1}};
  for (std::uint32_t part = 0; part < count; ++part) {
    add(std::size(kTags), 2);
    for (const auto& [tag, value] : kTags) {
      add(tag, 2);
      add(4, 2);  // 4 is the type of a 32-bit number
      add(1, 4);
      add(value, 4);
    }
    add(part + 1 < count ? static_cast<std::uint32_t>(bytes.size()) + 4 : 0, 4);
  }
  return bytes;
}

// Returns the processor time of several runs.
template <typename Run>
std::clock_t ticks_of(Run run) {
  const std::clock_t start = std::clock();
  for (int i = 0; i < 10; ++i) run();
  return std::clock() - start;
}

ConstantValues constants(const char* text) {
  return std::get<ConstantValues>(parameter_source("--specular", text));
}
MapName map(const std::string& text) { return std::get<MapName>(parameter_source("--specular", text)); }

}  // namespace

TEST_CASE("texture set: numbers are constants, anything else a file") {
  CHECK(constants("0.5") == ConstantValues{0.5f});
  CHECK(constants("0.9,0.6,0.2") == ConstantValues{0.9f, 0.6f, 0.2f});
  CHECK(map("0.5.exr").file == "0.5.exr");
  CHECK(map("a,b.exr").file == "a,b.exr");
  CHECK(map("").file == "");
  for (const char* bad : {"0.5,0.5", "-1", "1,2,3,4", "inf", "nan"})
    CHECK_THROWS_WITH(constants(bad), Contains("--specular: invalid value ") && Contains("give a file"));
}

TEST_CASE("texture set: the last colon separates a file from its channels") {
  CHECK(map("orm.png:G").file == "orm.png");
  CHECK(map("orm.png:G").channels == std::vector<std::string>{"G"});
  CHECK(map("a:b/c.exr:R,G,B").file == "a:b/c.exr");
  CHECK(map("a:b/c.exr:R,G,B").channels == std::vector<std::string>{"R", "G", "B"});
  CHECK(map("a:b/c.exr").file == "a:b/c.exr");
  CHECK(map("layers.exr:base.specular.R").channels == std::vector<std::string>{"base.specular.R"});
  CHECK(map(":G").file == ":G");
  for (const char* bad : {"a.png:", "a.png:R,G", "a.png:R,,B"}) CHECK_THROWS_AS(map(bad), Error);
  // If a file with this whole name exists, `:G` is part of the name and not a channel.
  const Files files;
  const std::string odd = files.image("odd:G.exr", {"Y"}).string();
  CHECK(map(odd).file == odd);
}

TEST_CASE("texture set: factors are one or three numbers from 0") {
  CHECK(parse_factors("--factor", "0.5") == std::vector<float>{0.5f});
  CHECK(parse_factors("--factor", "1,0.5,0").size() == 3);
  for (const char* bad : {"x", "-1", "1,2", "inf", ""})
    CHECK_THROWS_WITH(parse_factors("--factor", bad), Contains("--factor: invalid value "));
  const Files files;
  TextureSetRequest request;
  request.parameters[Parameter::kRoughness].source = MapName{files.image("r.exr", {"Y"}), {}};
  request.parameters[Parameter::kSpecular] = {kGrey, {1.0f, 1.0f, 1.0f}, std::nullopt};
  CHECK_THROWS_WITH(open_texture_set(request), Contains("--factor specular: has 3 values (give one"));
}

TEST_CASE("texture set: the roughness is the only channel, Y, or equal colors") {
  const Files files;
  CHECK(roughness_channels(files.image("1.exr", {"width"})) == std::vector<std::size_t>{0});
  CHECK(roughness_channels(files.image("2.exr", {"Y", "A"})) == std::vector<std::size_t>{0});
  CHECK(roughness_channels(files.image("3.exr", {"r", "g", "b"})) == std::vector<std::size_t>{1, 0, 2});
  CHECK(roughness_channels(files.image("4.exr", {"R", "G", "B"}), {"G"}) == std::vector<std::size_t>{1});
  CHECK(roughness_channels(files.image("5.exr", {"R", "G", "B"}), {"g"}) == std::vector<std::size_t>{1});
}

TEST_CASE("texture set: a packed file is opened once") {
  const Files files;
  const auto packed = files.image("packed.exr", {"R", "G", "B", "A"});
  const TextureSet set =
      opened(MapName{packed, {"A"}}, MapName{files.folder.path() / "." / "packed.exr", {"R", "G", "B"}});
  CHECK(set.maps.size() == 1);
  CHECK(set.parameters.at(Parameter::kRoughness).channels == std::vector<ChannelPlace>{{0, 3}});
  CHECK(set.parameters.at(Parameter::kSpecular).channels ==
        std::vector<ChannelPlace>{{0, 0}, {0, 1}, {0, 2}});
}

TEST_CASE("texture set: a missing channel is refused with the existing ones") {
  const Files files;
  const auto odd = files.image("odd.exr", {"first", "second"});
  CHECK_THROWS_WITH(opened(MapName{odd, {"secand"}}, kGrey),
                    Contains("no channel 'secand' (did you mean second?)"));
}

TEST_CASE("texture set: colors in whole numbers are read as sRGB, unless the file says linear") {
  const Files files;
  auto spec = test_spec(4, 3, {"R", "G", "B"}, OIIO::TypeUInt8);
  const auto png = files.folder.path() / "s.png";
  spec.attribute("oiio:ColorSpace", "sRGB");
  write_image(png, spec, noise);
  const auto roughness = files.image("r.exr", {"Y"});
  const TextureSet tagged = opened(MapName{roughness, {}}, MapName{png, {}});
  CHECK(tagged.parameters.at(Parameter::kSpecular).transfer == Transfer::kSrgb);
  CHECK(tagged.parameters.at(Parameter::kSpecular).transfer_reason == TransferReason::kFile);
  // The role decides, not the number of channels. A roughness is data.
  CHECK(opened(MapName{roughness, {}}, MapName{png, {"G"}}).parameters.at(Parameter::kSpecular).transfer ==
        Transfer::kSrgb);
  for (const std::string extension : {"png", "tga", "tif", "bmp", "jpg"}) {
    const auto plain = files.folder.path() / ("plain." + extension);
    write_image(plain, test_spec(4, 3, {"R", "G", "B"}, OIIO::TypeUInt8), noise);
    const auto set = opened(MapName{roughness, {}}, MapName{plain, {}});
    CHECK(set.parameters.at(Parameter::kSpecular).transfer == Transfer::kSrgb);
    CHECK(set.parameters.at(Parameter::kSpecular).transfer_reason == TransferReason::kUsual);
  }
  spec.attribute("oiio:ColorSpace", "Linear");
  const auto linear = files.folder.path() / "linear.png";
  write_image(linear, spec, noise);
  CHECK(opened(MapName{roughness, {}}, MapName{linear, {}}).parameters.at(Parameter::kSpecular).transfer ==
        Transfer::kLinear);
  CHECK(opened(MapName{png, {}}, kGrey).parameters.at(Parameter::kRoughness).transfer == Transfer::kLinear);
  CHECK(remarks(opened(MapName{roughness, {}}, MapName{files.image("s.exr", {"R", "G", "B"}), {}})).empty());
}

TEST_CASE("image reader: folders and missing parts are refused with the reason") {
  const Files files;
  CHECK_THROWS_WITH(ImageReader(files.folder.path()), Contains("is a folder"));
  CHECK_THROWS_WITH(ImageReader(files.image("one.exr", {"Y"}), 1),
                    Contains("part 1 not found (number of parts: 1)"));
}

TEST_CASE("image reader: only the first part of a file counts the parts, which takes long") {
  const TemporaryFolder folder;
  const auto most = folder.path() / "128.tif", more = folder.path() / "129.tif";
  std::ofstream(most, std::ios::binary) << tiff_of_parts(128);
  std::ofstream(more, std::ios::binary) << tiff_of_parts(129);
  CHECK(ImageReader(most).part_count() == 128);
  const auto first = ticks_of([&] { ImageReader{most, 0}; });
  const auto last = ticks_of([&] { ImageReader{most, 127}; });
  CHECK(2 * last < first);
  CHECK_THROWS_WITH(ImageReader(most, 128), Contains("part 128 not found (number of parts: 128)"));
  CHECK_THROWS_WITH(ImageReader(more), Contains("has more than 128 parts"));
  CHECK_THROWS_WITH(ImageReader(more, 128), Contains("has more than 128 parts"));
}

TEST_CASE("texture set: a lack of open files is not reported as a fault of the image") {
  const Files files;
  const auto image = files.image("r.exr", {"Y"});
  (void)image_library();  // loads the module first, because loading opens files, too
  // The limit is the number of open files.
  const int next = ::open("/dev/null", O_RDONLY);
  ::close(next);
  rlimit limits{};
  ::getrlimit(RLIMIT_NOFILE, &limits);
  rlimit few = limits;
  few.rlim_cur = static_cast<rlim_t>(next);
  ::setrlimit(RLIMIT_NOFILE, &few);
  std::string message;
  try {
    ImageReader reader(image);
  } catch (const Error& error) {
    // restores the limit first, because a sanitizer opens files to examine an object
    ::setrlimit(RLIMIT_NOFILE, &limits);
    message = error.what();
  }
  ::setrlimit(RLIMIT_NOFILE, &limits);
  CHECK_THAT(message, Contains("r.exr: cannot be read: Too many open files"));
}
