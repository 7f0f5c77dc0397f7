// This file tests files of several parts and of several mip levels, copies of normal maps with inverted
// green, and damaged files, which are cut short or have flipped bits. Each damaged file is converted or
// refused with a reason. It must not crash or hang, and a refused file must not appear under its final
// name. Sanitizers check this, too.
#include <fstream>
#include <iostream>
#include <random>

#include <OpenImageIO/imagebufalgo.h>
#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "remap/error.hpp"
#include "support/campaign.hpp"
#include "support/error_of.hpp"
#include "support/example_fit.hpp"
#include "support/fitted_converter.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_image.hpp"
#include "texture/image_library.hpp"
#include "texture/normal_green.hpp"
#include "texture/target_plan.hpp"
#include "texture/texture_pass.hpp"

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

TEST_CASE("image library: it can be loaded, and the program can catch its errors") {
  CHECK(&image_library() == &image_library());
  const TemporaryFolder folder;
  const auto text = folder.path() / "text.png";
  write_file(text, "no image");
  CHECK_THAT(error_of([&] { (void)image_library().open(text, 0); }, ErrorKind::kInput),
             Contains("text.png: cannot be read as an image"));
}

namespace {

struct Plane {
  OIIO::ImageSpec spec;
  std::vector<float> values;
  float at(int x, int y, int c) const {
    return values[static_cast<std::size_t>((y * spec.width + x) * spec.nchannels + c)];
  }
};

// Reads only with OpenImageIO. The description is empty if the plane does not exist.
Plane read_plane(const fs::path& path, int part, int level) {
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(path.string(), &hints);
  REQUIRE(input != nullptr);
  Plane plane;
  if (!input->seek_subimage(part, level)) return plane;
  plane.spec = input->spec();
  plane.values.resize(static_cast<std::size_t>(plane.spec.width * plane.spec.height * plane.spec.nchannels));
  REQUIRE(input->read_image(part, level, 0, plane.spec.nchannels, OIIO::TypeFloat, plane.values.data()));
  return plane;
}

void write_parts(const fs::path& path, const std::vector<OIIO::ImageSpec>& specs) {
  const auto output = OIIO::ImageOutput::create(path.string());
  for (std::size_t p = 0; p < specs.size(); ++p) {
    const OIIO::ImageSpec& spec = specs[p];
    std::vector<float> values;
    for (int y = 0; y < spec.height; ++y)
      for (int x = 0; x < spec.width; ++x)
        for (int c = 0; c < spec.nchannels; ++c) values.push_back(noise(x, y, c + 5 * static_cast<int>(p)));
    if (p == 0 && path.extension() == ".exr")
      REQUIRE(output->open(path.string(), static_cast<int>(specs.size()), specs.data()));
    else
      REQUIRE(output->open(path.string(), spec,
                           p == 0 ? OIIO::ImageOutput::Create : OIIO::ImageOutput::AppendSubimage));
    REQUIRE(output->write_image(OIIO::TypeFloat, values.data()));
  }
  REQUIRE(output->close());
}

void write_levels(const fs::path& path, const std::vector<std::string>& channels, int width, int height) {
  const fs::path plain = path.parent_path() / ("plain_" + path.stem().string() + ".exr");
  write_image(plain, test_spec(width, height, channels, OIIO::TypeHalf), noise);
  OIIO::ImageSpec config;
  config.attribute("maketx:fileformatname", path.extension() == ".exr" ? "openexr" : "tiff");
  REQUIRE(OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, plain.string(), path.string(),
                                           config));
}

MapStatistics convert(const std::string& roughness, const std::string& specular, const fs::path& folder,
                      const Converter& converter) {
  TextureSetRequest request;
  request.parameters[Parameter::kRoughness].source = parameter_source("--roughness", roughness);
  request.parameters[Parameter::kSpecular].source = parameter_source("--specular", specular);
  TextureSet set = open_texture_set(request);
  TargetChoice choice;
  choice.folder = folder;
  std::vector<TargetMap> targets = open_targets(set, plan_targets(set, choice));
  PassOptions options;
  options.thread_count = 2;
  return run_texture_pass(set, targets, converter, options);
}

}  // namespace

TEST_CASE("image planes: every mip level is converted separately") {
  const auto converter = make_interpreted_converter(example_fit());
  const TemporaryFolder folder;
  const std::string extension = GENERATE("exr", "tif");
  const fs::path r = folder.path() / ("r." + extension), s = folder.path() / ("s." + extension);
  const auto [width, height] = GENERATE(std::pair{128, 64}, std::pair{100, 37});
  write_levels(r, {"Y"}, width, height);
  write_levels(s, {"R", "G", "B"}, width, height);
  const MapStatistics statistics = convert(r.string(), s.string(), folder.path() / "out", *converter);
  CHECK(statistics.texel_count == static_cast<std::size_t>(width * height));
  int level = 0;
  for (;; ++level) {
    INFO("level " << level);
    const Plane rough = read_plane(r, 0, level), spec = read_plane(s, 0, level);
    const Plane rough_out = read_plane(folder.path() / "out" / r.filename(), 0, level),
                spec_out = read_plane(folder.path() / "out" / s.filename(), 0, level);
    REQUIRE(rough_out.spec.width == rough.spec.width);
    REQUIRE(spec_out.spec.height == spec.spec.height);
    REQUIRE(spec_out.spec.tile_width == spec.spec.tile_width);
    if (rough.values.empty()) break;
    for (int y = 0; y < rough.spec.height; ++y)
      for (int x = 0; x < rough.spec.width; ++x) {
        const auto expected = converted_texel(*converter, rough.at(x, y, 0),
                                              {spec.at(x, y, 0), spec.at(x, y, 1), spec.at(x, y, 2)});
        REQUIRE(rough_out.at(x, y, 0) == Approx(expected[0]).epsilon(1e-3));
        for (int c = 0; c < 3; ++c)
          REQUIRE(spec_out.at(x, y, c) ==
                  Approx(expected[static_cast<std::size_t>(c) + 1]).epsilon(1e-3).margin(1e-6));
      }
  }
  CHECK(level >= 6);
}

TEST_CASE("image planes: maps with different numbers of levels are refused") {
  const auto converter = make_interpreted_converter(example_fit());
  const TemporaryFolder folder;
  write_levels(folder.path() / "r.exr", {"Y"}, 64, 64);
  write_image(folder.path() / "s.exr", test_spec(64, 64, {"R", "G", "B"}, OIIO::TypeHalf), noise);
  CHECK_THROWS_WITH(convert((folder.path() / "r.exr").string(), (folder.path() / "s.exr").string(),
                            folder.path() / "out", *converter),
                    Contains("s.exr: number of mip levels is 1, but other maps of the set have 7"));
  CHECK(fs::is_empty(folder.path() / "out"));
  // A number is used for every mip level.
  CHECK_NOTHROW(convert((folder.path() / "r.exr").string(), "0.5", folder.path() / "out", *converter));
  CHECK(read_plane(folder.path() / "out" / "specular.exr", 0, 3).spec.width == 8);
}

TEST_CASE("image planes: parts with parameters are converted, the others are unchanged") {
  const auto converter = make_interpreted_converter(example_fit());
  const TemporaryFolder folder;
  const std::string extension = GENERATE("exr", "tif");
  const fs::path file = folder.path() / ("parts." + extension), out = folder.path() / "out" / file.filename();
  std::vector<OIIO::ImageSpec> specs = {test_spec(40, 30, {"R", "G", "B", "A"}, OIIO::TypeFloat),
                                        test_spec(17, 9, {"id"}, OIIO::TypeFloat),
                                        test_spec(40, 30, {"width"}, OIIO::TypeFloat)};
  const bool is_exr = extension == "exr";
  specs[1].full_width = 40;  // all parts of an EXR have the same display window
  specs[1].full_height = 30;
  const char* names[] = {"base", "ids", "rough"};
  for (std::size_t p = 0; is_exr && p < 3; ++p) specs[p].attribute("oiio:subimagename", names[p]);
  write_parts(file, specs);
  const std::string path = file.string();
  if (is_exr) {
    convert(path + ":rough.width", path + ":base.R,base.G,base.B", folder.path() / "out", *converter);
  } else {
    // TIFF has no names of channels or parts. Colors are found, but one of two grey parts is not.
    CHECK_THROWS_WITH(convert(path, path, folder.path() / "out", *converter), Contains("have such channels"));
    convert("0.5", path + ":R,G,B", folder.path() / "out", *converter);
  }
  const Plane base = read_plane(file, 0, 0), rough = read_plane(file, 2, 0), base_out = read_plane(out, 0, 0),
              rough_out = read_plane(out, 2, 0);
  CHECK(read_plane(out, 1, 0).values == read_plane(file, 1, 0).values);
  CHECK(read_plane(out, 3, 0).values.empty());
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) {
      const auto expected = converted_texel(*converter, is_exr ? rough.at(x, y, 0) : 0.5f,
                                            {base.at(x, y, 0), base.at(x, y, 1), base.at(x, y, 2)});
      REQUIRE(rough_out.at(x, y, 0) == (is_exr ? expected[0] : rough.at(x, y, 0)));
      for (int c = 0; c < 3; ++c) REQUIRE(base_out.at(x, y, c) == expected[static_cast<std::size_t>(c) + 1]);
      REQUIRE(base_out.at(x, y, 3) == base.at(x, y, 3));
    }
  if (is_exr) CHECK(base_out.spec.get_string_attribute("oiio:subimagename") == "base");
}

TEST_CASE("normal green: names say it by words, and have a name for the other way") {
  const std::vector<std::pair<std::string, std::string>> pairs = {
      {"wood_nor_gl_4k.exr", "wood_nor_dx_4k.exr"},
      {"Wood_4K-PNG_NormalGL.png", "Wood_4K-PNG_NormalDX.png"},
      {"x_Normal_OpenGL.png", "x_Normal_DirectX.png"},
      {"x_normal_opengl.1001.png", "x_normal_directx.1001.png"}};
  for (const auto& [up, down] : pairs) {
    CHECK(stated_green(up) == NormalGreen::kUp);
    CHECK(turned_name(up) == down);
  }
  CHECK(stated_green("wood_nor_dx_4k.exr") == NormalGreen::kDown);
  CHECK(turned_name("wood_nor_dx_4k.exr") == "wood_nor_gl_4k.exr");
  for (const std::string silent :
       {"wood_normal.png", "x_glass_normal.png", "angle_nor.png", "dxf_normal.png"})
    CHECK_FALSE(stated_green(silent));
}

TEST_CASE("normal green: an inverted copy differs only in green, for every pixel type") {
  const TemporaryFolder folder;
  const auto type = GENERATE(OIIO::TypeDesc(OIIO::TypeDesc::UINT8), OIIO::TypeDesc(OIIO::TypeDesc::UINT16),
                             OIIO::TypeDesc(OIIO::TypeDesc::HALF));
  const std::string end = type.is_floating_point() ? ".exr" : ".png";
  const auto from = folder.path() / ("nor_gl" + end), to = folder.path() / "made" / ("nor_dx" + end);
  write_image(from, test_spec(70, 130, {"R", "G", "B"}, type), noise);
  const TestImage before = read_image(from);
  {
    const auto copy = turned_copy(std::make_shared<const InputFile>(from), to);
    CHECK_FALSE(std::filesystem::exists(to));
    copy->commit(Flush::kNo);
  }
  const TestImage after = read_image(to);
  REQUIRE(after.values.size() == before.values.size());
  const float step = type == OIIO::TypeDesc(OIIO::TypeDesc::HALF) ? 1e-3f : 1e-6f;
  for (std::size_t i = 0; i < after.values.size(); ++i)
    if (i % 3 == 1)
      REQUIRE(after.values[i] == Approx(1.0f - before.values[i]).margin(step));
    else
      REQUIRE(after.values[i] == before.values[i]);
}

TEST_CASE("normal green: values with a sign change it") {
  const TemporaryFolder folder;
  const auto from = folder.path() / "n.exr", to = folder.path() / "m.exr";
  const auto texel = [](int x, int y, int channel) { return 2.0f * noise(x, y, channel) - 1.0f; };
  write_image(from, test_spec(8, 8, {"R", "G", "B"}, OIIO::TypeFloat), texel);
  turned_copy(std::make_shared<const InputFile>(from), to)->commit(Flush::kNo);
  CHECK(read_image(to).at(3, 5, 1) == -texel(3, 5, 1));
  CHECK(read_image(to).at(3, 5, 2) == texel(3, 5, 2));
}

TEST_CASE("normal green: a map without green cannot be turned, and leaves nothing behind") {
  const TemporaryFolder folder;
  write_image(folder.path() / "n.png", test_spec(8, 8, {"Y"}, OIIO::TypeUInt8), noise);
  CHECK_THROWS_WITH(
      turned_copy(std::make_shared<const InputFile>(folder.path() / "n.png"), folder.path() / "m.png"),
      Contains("has no green channel to invert"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "m.png"));
}

namespace {

struct Format {
  std::string extension;
  std::string compression;
  OIIO::TypeDesc type;
  int tile = 0;
};

std::vector<Format> formats() {
  return {
      {"exr", "none", OIIO::TypeHalf},  {"exr", "zip", OIIO::TypeHalf},      {"exr", "piz", OIIO::TypeHalf},
      {"exr", "dwaa", OIIO::TypeHalf},  {"exr", "zip", OIIO::TypeFloat, 32}, {"tif", "none", OIIO::TypeUInt8},
      {"tif", "zip", OIIO::TypeUInt16}, {"tif", "lzw", OIIO::TypeUInt8, 32}, {"png", "", OIIO::TypeUInt8},
      {"jpg", "", OIIO::TypeUInt8},     {"tga", "", OIIO::TypeUInt8},        {"bmp", "", OIIO::TypeUInt8},
      {"hdr", "", OIIO::TypeFloat}};
}

// A fifth of the mutations cut the file. Half of the others flip bits in the header.
std::string mutated(std::string bytes, int number) {
  std::mt19937 random(static_cast<unsigned>(number));
  const auto below = [&](std::size_t limit) { return static_cast<std::size_t>(random()) % limit; };
  if (number % 5 == 0) {
    bytes.resize(below(bytes.size()));
    return bytes;
  }
  for (std::size_t flips = 1 + below(4); flips-- > 0;) {
    const std::size_t at = below(number % 2 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 1024));
    bytes[at] = static_cast<char>(bytes[at] ^ 1 << below(8));
  }
  return bytes;
}

}  // namespace

TEST_CASE("damaged files: a PNG chunk longer than the file is refused before memory is taken for it") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "long.png";
  write_image(path, test_spec(4, 4, {"Y"}, OIIO::TypeUInt8), noise);
  std::string bytes = read_file(path);
  // Inserts a text chunk that claims 2.8 GB after the header of 33 bytes.
  bytes.insert(33, std::string("\xa8\x00\x00\x00tEXtKey", 11));
  write_file(path, bytes);
  CHECK_THROWS_WITH(ImageReader(path), Contains("chunk tEXt claims to be longer than the file"));
}

TEST_CASE("damaged files: converted or refused, nothing else", "[slow][campaign]") {
  const int mutations = campaign_length(500);
  const auto converter = make_lowered_converter(example_fit());
  for (const Format& format : formats()) {
    const TemporaryFolder folder;
    const auto file = folder.path() / ("s." + format.extension), out = folder.path() / "out";
    OIIO::ImageSpec spec = test_spec(64, 64, {"R", "G", "B"}, format.type);
    spec.tile_width = spec.tile_height = format.tile;
    if (!format.compression.empty()) spec.attribute("Compression", format.compression);
    write_image(file, spec, noise);
    REQUIRE_NOTHROW(convert("0.3", file.string(), out, *converter));
    const std::string whole = read_file(file);
    int converted = 0, refused = 0;
    for (int number = 0; number < mutations; ++number) {
      INFO(format.extension << " " << format.compression << " mutation " << number);
      std::ofstream(file, std::ios::binary) << mutated(whole, number);
      std::filesystem::remove_all(out);
      try {
        convert("0.3", file.string(), out, *converter);
        ++converted;
      } catch (const Error& error) {
        ++refused;
        CHECK(std::string(error.what()).find(folder.path().string()) != std::string::npos);
        if (std::filesystem::exists(out)) CHECK(std::filesystem::is_empty(out));
      }
    }
    std::cout << "damaged " << format.extension << " " << format.compression << ": " << converted
              << " converted, " << refused << " refused\n";
    CHECK(refused >= mutations / 20);
  }
}
