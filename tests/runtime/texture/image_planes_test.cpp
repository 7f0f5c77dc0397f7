// This file tests files of several parts and of several mip levels.
#include <OpenImageIO/imagebufalgo.h>
#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "support/example_fit.hpp"
#include "support/fitted_converter.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_image.hpp"
#include "texture/target_plan.hpp"
#include "texture/texture_pass.hpp"

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

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

std::array<float, 4> converted_texel(const Converter& converter, float roughness,
                                     std::array<float, 3> specular) {
  std::array<float, 4> result{};
  const std::array<const float*, 3> in = {&specular[0], &specular[1], &specular[2]};
  const std::array<float*, 3> out = {&result[1], &result[2], &result[3]};
  converter.convert(1, &roughness, in, &result[0], out);
  return result;
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
