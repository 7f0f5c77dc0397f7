// This file tests damaged files, which are cut short or have flipped bits. Each file is converted or refused
// with a reason. It must not crash or hang, and a refused file must not appear under its final name.
// Sanitizers check this, too.
#include <fstream>
#include <iostream>
#include <random>

#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "remap/error.hpp"
#include "support/campaign.hpp"
#include "support/example_fit.hpp"
#include "support/fitted_converter.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_image.hpp"
#include "texture/target_plan.hpp"
#include "texture/texture_pass.hpp"

using namespace remap;

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

void convert(const std::filesystem::path& file, const std::filesystem::path& folder,
             const Converter& converter) {
  TextureSetRequest request;
  request.parameters[Parameter::kRoughness].source = ConstantValues{0.3f};
  request.parameters[Parameter::kSpecular].source = MapName{file, {}};
  TextureSet set = open_texture_set(request);
  TargetChoice choice;
  choice.folder = folder;
  std::vector<TargetMap> targets = open_targets(set, plan_targets(set, choice));
  run_texture_pass(set, targets, converter, {});
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
  CHECK_THROWS_WITH(ImageReader(path),
                    Catch::Matchers::Contains("chunk tEXt claims to be longer than the file"));
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
    REQUIRE_NOTHROW(convert(file, out, *converter));
    const std::string whole = read_file(file);
    int converted = 0, refused = 0;
    for (int number = 0; number < mutations; ++number) {
      INFO(format.extension << " " << format.compression << " mutation " << number);
      std::ofstream(file, std::ios::binary) << mutated(whole, number);
      std::filesystem::remove_all(out);
      try {
        convert(file, out, *converter);
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
