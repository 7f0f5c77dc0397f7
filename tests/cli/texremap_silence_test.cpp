// This file tests that no mistake is silent: the color spaces of results, what file names state, and
// conventions after a round trip.
#include <cmath>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/texremap_tree.hpp"

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

void write_flat(const Tree& tree, const std::string& name, const std::vector<float>& values,
                OIIO::TypeDesc type = OIIO::TypeUInt8) {
  const std::vector<std::string> channels = values.size() == 1   ? kGrey
                                            : values.size() == 3 ? kColor
                                                                 : kWithAlpha;
  fs::create_directories(fs::path(tree.path(name)).parent_path());
  tree.make(name, test_spec(8, 8, channels, type),
            [&](int, int, int c) { return values[static_cast<std::size_t>(c)]; });
}

// Returns the first texel, in steps of 1/255.
std::vector<int> texel(const Tree& tree, const std::string& name) {
  const TestImage image = tree.image(name);
  std::vector<int> values;
  for (int c = 0; c < image.spec.nchannels; ++c)
    values.push_back(static_cast<int>(std::lround(255.0f * image.at(0, 0, c))));
  return values;
}

bool has_chunk(const Tree& tree, const std::string& name, const std::string& chunk) {
  return tree.content(name).find(chunk) != std::string::npos;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

ProcessResult convert(const Tree& tree, Words words) { return tree.texremap(Words("convert") + words); }

}  // namespace

TEST_CASE("texremap silence: a color that is made from numbers or EXR is sRGB in whole numbers", "[slow]") {
  const Tree tree;
  write_flat(tree, "r.png", {0.5f});
  write_flat(tree, "b.exr", {0.5f, 0.2f, 0.05f}, OIIO::TypeHalf);
  write_flat(tree, "r.exr", {0.5f}, OIIO::TypeHalf);
  const std::string format = GENERATE("png", "tga", "tif", "bmp");
  const Words output = "--metallic 1 --to usd-preview-surface --from gltf --layout separate --format " +
                       format + " --type uint8 -o out";
  const auto converted = [&](const Words& maps) {
    Words words = output;
    words += maps;
    words.push_back("--force");
    const ProcessResult result = require_success(convert(tree, words));
    CHECK(count(result.errors, "texremap: color:") == 1);
    CHECK_THAT(result.errors, Contains("base_color written as srgb"));
    return texel(tree, "out/base_color." + format);
  };
  const std::vector<int> srgb = {188, 124, 63};  // by the curve of IEC 61966-2-1
  CHECK(converted("--base-color 0.5,0.2,0.05 --roughness r.png") == srgb);
  CHECK(converted("--base-color b.exr --roughness r.png") == srgb);
  CHECK(converted("--base-color b.exr --roughness r.exr") == srgb);
  CHECK(texel(tree, "out/roughness." + format).front() == 128);  // data has no curve
  if (format == "png") {
    // This is what glTF viewers expect: color is tagged sRGB, and data has no gamma tag that means linear.
    CHECK(has_chunk(tree, "out/base_color.png", "sRGB"));
    for (const char* name : {"out/roughness.png", "out/metallic.png"}) {
      CHECK_FALSE(has_chunk(tree, name, "gAMA"));
      CHECK_FALSE(has_chunk(tree, name, "sRGB"));
    }
  }
}

TEST_CASE("texremap silence: specular from a number beside an 8-bit roughness is sRGB") {
  const Tree tree;
  write_flat(tree, "r.png", {0.5f});
  require_success(convert(tree,
                          "--from gltf-specgloss --to specular --roughness r.png --diffuse 0.5 --specular "
                          "0.04 --layout separate -o out"));
  CHECK(texel(tree, "out/specular.png") == std::vector<int>{56, 56, 56});
}

TEST_CASE(
    "texremap silence: the line on colors counts the maps of a folder, for whatever reason they are sRGB") {
  const Tree tree;
  for (const std::string set : {"in/a", "in/b"}) tree.map(set + "_roughness.png", {"Y"});
  tree.map("in/a_specular.png", {"R", "G", "B"});
  tree.map("in/b_specular.exr", {"R", "G", "B"}, OIIO::TypeHalf);
  const ProcessResult result = require_success(
      convert(tree, "in --from mitsuba/ward --to mitsuba/as --format png --type uint8 -o out"));
  CHECK_THAT(result.errors,
             Contains("color: specular read as srgb in 1 map, specular written as srgb in 2 maps;"));
}

TEST_CASE("texremap silence: a color space on request, and back without a word") {
  const Tree tree;
  write_flat(tree, "b.png", {188.0f / 255.0f, 124.0f / 255.0f, 63.0f / 255.0f});
  const std::string format = GENERATE("png", "tif");
  const ProcessResult linear =
      require_success(convert(tree,
                              "--from gltf --to usd-preview-surface --base-color b.png --metallic 1 "
                              "--roughness 0.5 --layout separate --format " +
                                  format + " --output-color-space base_color=linear -o linear"));
  CHECK_THAT(linear.errors,
             Contains("base_color read as srgb, base_color written as linear (--output-color-space)"));
  CHECK(texel(tree, "linear/base_color." + format) == std::vector<int>{128, 51, 13});
  // The file is tagged linear, and is read as linear.
  const ProcessResult back = require_success(
      convert(tree, "--from usd-preview-surface --to gltf --base-color linear/base_color." + format +
                        " --metallic 1 --roughness 0.5 --output-color-space srgb -o back"));
  CHECK_THAT(back.errors, Contains("base_color read as linear (as the file's tag states)"));
  const std::vector<int> again = texel(tree, "back/base_color." + format);
  CHECK(std::abs(again[0] - 188) <= 1);
  CHECK(std::abs(again[1] - 124) <= 1);
}

TEST_CASE(
    "texremap silence: metals of three.js are inside the domain, and dielectrics come back with metallic 0") {
  const Tree tree;
  const auto numbers = [&](const std::string& from, const std::string& to, const Words& more) {
    Words words = "--from " + from + " --to " + to + " --json";
    words += more;
    const ProcessResult result = require_success(convert(tree, words));
    return nlohmann::json::parse(result.output);
  };
  for (const std::string roughness : {"0.15", "0.5", "0.7", "1"}) {
    INFO("roughness " << roughness);
    const auto gold = numbers("threejs/standard", "gltf",
                              "--base-color 0.944,0.776,0.373 --metallic 1 --roughness " + roughness);
    CHECK(gold["in_domain"] == true);
    CHECK(gold["values"]["metallic"].get<double>() == Approx(1.0).margin(0.005));
    const auto plastic = numbers("threejs/standard", "gltf",
                                 "--base-color 0.5,0.2,0.05 --metallic 0 --roughness " + roughness);
    CHECK(plastic["values"]["metallic"].get<double>() == 0.0);
    CHECK(plastic["values"]["base_color"][0].get<double>() == Approx(0.5 / 0.96).margin(1e-3));
    // Metallic between 0 and 1 follows the same formula, without a jump at 0.
    const auto mixed = numbers("threejs/standard", "gltf",
                               "--base-color 0.8,0.6,0.4 --metallic 0.02 --roughness " + roughness);
    CHECK(mixed["values"]["metallic"].get<double>() == Approx(0.02).margin(0.01));
  }
}

TEST_CASE("texremap silence: --nan clamp clamps what is only passed on") {
  const Tree tree;
  write_flat(tree, "c.exr", {0.5f, 0.4f, 0.3f}, OIIO::TypeFloat);
  tree.make("r.exr", test_spec(8, 8, kGrey, OIIO::TypeFloat), [](int x, int, int) {
    return x == 0 ? 1e38f : x == 1 ? INFINITY : x == 2 ? NAN : x == 3 ? -2.0f : 0.5f;
  });
  require_success(convert(tree,
                          "--from gltf --to usd-preview-surface --base-color c.exr --metallic 0 --roughness "
                          "r.exr --nan clamp -o out"));
  const TestImage out = tree.image("out/r.exr");
  for (int x = 0; x < 8; ++x) CHECK(out.at(x, 0, 0) == (x < 2 ? 1.0f : x < 4 ? 0.0f : 0.5f));
}
