// Nothing wrong in silence: the color spaces of results, what names of files say, and conventions
// there and back.
#include <cmath>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "cli/texremap_tree.hpp"

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

using Words = std::vector<std::string>;

void write_flat(const Tree& tree, const std::string& name, const std::vector<float>& values,
                OIIO::TypeDesc type = OIIO::TypeUInt8) {
  const std::vector<std::string> channels = values.size() == 1   ? kGrey
                                            : values.size() == 3 ? kColor
                                                                 : kWithAlpha;
  fs::create_directories(fs::path(tree.path(name)).parent_path());
  write_image(tree.path(name), test_spec(8, 8, channels, type),
              [&](int, int, int c) { return values[static_cast<std::size_t>(c)]; });
}

// The first texel, in steps of 1/255.
std::vector<int> texel(const Tree& tree, const std::string& name) {
  const TestImage image = read_image(tree.path(name));
  std::vector<int> values;
  for (int c = 0; c < image.spec.nchannels; ++c)
    values.push_back(static_cast<int>(std::lround(255.0f * image.at(0, 0, c))));
  return values;
}

bool has_chunk(const Tree& tree, const std::string& name, const std::string& chunk) {
  return read_file(tree.path(name)).find(chunk) != std::string::npos;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

ProcessResult convert(const Tree& tree, Words words) {
  words.insert(words.begin(), "convert");
  return tree.texremap(words);
}

}  // namespace

TEST_CASE("texremap silence: a color that is made from numbers or EXR is sRGB in whole numbers") {
  const Tree tree;
  write_flat(tree, "r.png", {0.5f});
  write_flat(tree, "b.exr", {0.5f, 0.2f, 0.05f}, OIIO::TypeHalf);
  write_flat(tree, "r.exr", {0.5f}, OIIO::TypeHalf);
  const std::string format = GENERATE("png", "tga", "tif", "bmp");
  const Words output = {"--metallic", "1",
                        "--to",       "usd-preview-surface",
                        "--from",     "gltf",
                        "--layout",   "separate",
                        "--format",   format,
                        "--type",     "uint8",
                        "-o",         tree.path("out")};
  const auto converted = [&](const Words& maps) {
    Words words = output;
    words.insert(words.end(), maps.begin(), maps.end());
    words.push_back("--force");
    const ProcessResult result = require_success(convert(tree, words));
    CHECK(count(result.errors, "texremap: color:") == 1);
    CHECK_THAT(result.errors, Contains("base_color written as srgb"));
    return texel(tree, "out/base_color." + format);
  };
  const std::vector<int> srgb = {188, 124, 63};  // IEC 61966-2-1
  CHECK(converted({"--base-color", "0.5,0.2,0.05", "--roughness", tree.path("r.png")}) == srgb);
  CHECK(converted({"--base-color", tree.path("b.exr"), "--roughness", tree.path("r.png")}) == srgb);
  CHECK(converted({"--base-color", tree.path("b.exr"), "--roughness", tree.path("r.exr")}) == srgb);
  CHECK(texel(tree, "out/roughness." + format).front() == 128);  // data
  if (format == "png") {
    // What glTF readers expect: color has sRGB, and data no gamma that says linear.
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
  require_success(convert(
      tree, {"--from", "gltf-specgloss", "--to", "specular", "--roughness", tree.path("r.png"), "--diffuse",
             "0.5", "--specular", "0.04", "--layout", "separate", "-o", tree.path("out")}));
  CHECK(texel(tree, "out/specular.png") == std::vector<int>{56, 56, 56});
}

TEST_CASE(
    "texremap silence: the line on colors counts the maps of a folder, for whatever reason they are sRGB") {
  const Tree tree;
  for (const std::string set : {"in/a", "in/b"}) tree.map(set + "_roughness.png", {"Y"});
  tree.map("in/a_specular.png", {"R", "G", "B"});
  tree.map("in/b_specular.exr", {"R", "G", "B"}, OIIO::TypeHalf);
  const ProcessResult result =
      require_success(convert(tree, {tree.path("in"), "--from", "mitsuba/ward", "--to", "mitsuba/as",
                                     "--format", "png", "--type", "uint8", "-o", tree.path("out")}));
  CHECK_THAT(result.errors,
             Contains("color: specular read as srgb in 1 map, specular written as srgb in 2 maps;"));
}

TEST_CASE("texremap silence: whole numbers are read as sRGB in every format, and floats as linear") {
  const Tree tree;
  const auto [extension, type] = GENERATE(table<std::string, OIIO::TypeDesc>({{"png", OIIO::TypeUInt8},
                                                                              {"tga", OIIO::TypeUInt8},
                                                                              {"tif", OIIO::TypeUInt8},
                                                                              {"tif", OIIO::TypeUInt16},
                                                                              {"bmp", OIIO::TypeUInt8},
                                                                              {"jpg", OIIO::TypeUInt8},
                                                                              {"exr", OIIO::TypeHalf},
                                                                              {"tif", OIIO::TypeFloat},
                                                                              {"hdr", OIIO::TypeFloat}}));
  const float stored = is_whole(type) ? 188.0f / 255.0f : 0.5f;
  write_flat(tree, "b." + extension, {stored, stored, stored}, type);
  require_success(
      convert(tree, {"--from", "gltf", "--to", "usd-preview-surface", "--base-color",
                     tree.path("b." + extension), "--metallic", "0", "--roughness", "0.5", "--layout",
                     "separate", "--format", "exr", "--type", "float", "-o", tree.path("out")}));
  CHECK(read_image(tree.path("out/base_color.exr")).at(0, 0, 0) == Approx(0.5).margin(0.006));
}

TEST_CASE("texremap silence: a color space on request, and back without a word") {
  const Tree tree;
  write_flat(tree, "b.png", {188.0f / 255.0f, 124.0f / 255.0f, 63.0f / 255.0f});
  const std::string format = GENERATE("png", "tif");
  const ProcessResult linear = require_success(
      convert(tree, {"--from", "gltf", "--to", "usd-preview-surface", "--base-color", tree.path("b.png"),
                     "--metallic", "1", "--roughness", "0.5", "--layout", "separate", "--format", format,
                     "--output-color-space", "base_color=linear", "-o", tree.path("linear")}));
  CHECK_THAT(linear.errors,
             Contains("base_color read as srgb, base_color written as linear (--output-color-space)"));
  CHECK(texel(tree, "linear/base_color." + format) == std::vector<int>{128, 51, 13});
  // The file says linear, and is read so.
  const ProcessResult back = require_success(
      convert(tree, {"--from", "usd-preview-surface", "--to", "gltf", "--base-color",
                     tree.path("linear/base_color." + format), "--metallic", "1", "--roughness", "0.5",
                     "--output-color-space", "srgb", "-o", tree.path("back")}));
  CHECK_THAT(back.errors, Contains("base_color read as linear (tagged so by the file)"));
  const std::vector<int> again = texel(tree, "back/base_color." + format);
  CHECK(std::abs(again[0] - 188) <= 1);
  CHECK(std::abs(again[1] - 124) <= 1);
}

TEST_CASE("texremap silence: a file named smoothness or glossiness holds it afterwards") {
  const Tree tree;
  const std::string to = GENERATE("cycles-5/principled", "usd-preview-surface");
  write_flat(tree, "in/Robot_BaseColor.png", {0.7f, 0.5f, 0.3f});
  write_flat(tree, "in/Robot_Metallic.png", {1.0f});
  write_flat(tree, "in/Robot_Smoothness.png", {179.0f / 255.0f});
  write_flat(tree, "in/Lamp_BaseColor.png", {0.7f, 0.5f, 0.3f});
  write_flat(tree, "in/Lamp_MetallicSmoothness.png", {1.0f, 1.0f, 1.0f, 179.0f / 255.0f});
  write_flat(tree, "in/Chair_BaseColor.png", {0.7f, 0.5f, 0.3f});
  write_flat(tree, "in/Chair_MaskMap.png", {1.0f, 0.75f, 0.25f, 179.0f / 255.0f});
  require_success(convert(tree, {tree.path("in"), "--from", "gltf", "--to", to, "-o", tree.path("out")}));
  CHECK(std::abs(texel(tree, "out/Robot_Smoothness.png")[0] - 179) <= 1);
  CHECK(std::abs(texel(tree, "out/Lamp_MetallicSmoothness.png")[3] - 179) <= 1);
  CHECK(std::abs(texel(tree, "out/Chair_MaskMap.png")[3] - 179) <= 1);
  CHECK(texel(tree, "out/Chair_MaskMap.png")[2] == 64);
  // In a layout that names its files, these names are true: orm holds roughness.
  fs::remove_all(tree.path("in"));
  write_flat(tree, "in/Robot_BaseColor.png", {0.7f, 0.5f, 0.3f});
  write_flat(tree, "in/Robot_Metallic.png", {1.0f});
  write_flat(tree, "in/Robot_Smoothness.png", {179.0f / 255.0f});
  require_success(convert(tree, {tree.path("in"), "--from", "gltf", "--to", to, "--layout", "orm", "-o",
                                 tree.path("orm_of_gltf")}));
  CHECK(std::abs(texel(tree, "orm_of_gltf/Robot_orm.png")[1] - 76) <= 1);
  // A BRDF alone, too.
  write_flat(tree, "brdf/Robot_Smoothness.png", {179.0f / 255.0f});
  for (const char* layout : {"as-inputs", "separate", "orm", "specgloss"})
    require_success(convert(tree, {tree.path("brdf"), "--from", "mitsuba/ggx", "--to", "cycles-5/ggx",
                                   "--specular", "0.04", "--layout", layout, "-o", tree.path(layout)}));
  CHECK(std::abs(texel(tree, "as-inputs/Robot_Smoothness.png")[0] - 179) <= 1);
  CHECK(std::abs(texel(tree, "separate/Robot_glossiness.png")[0] - 179) <= 1);
  CHECK(std::abs(texel(tree, "orm/Robot_orm.png")[1] - 76) <= 1);
  CHECK(std::abs(texel(tree, "specgloss/Robot_specular_glossiness.png")[3] - 179) <= 1);
}

TEST_CASE("texremap silence: --roughness-encoding speaks of maps found as roughness") {
  const Tree tree;
  write_flat(tree, "in/a_Roughness.png", {0.5f});
  write_flat(tree, "in/b_Glossiness.png", {64.0f / 255.0f});
  write_flat(tree, "in/c_SpecularGlossiness.png", {0.2f, 0.2f, 0.2f, 64.0f / 255.0f});
  write_flat(tree, "in/d_MaskMap.png", {0.0f, 1.0f, 0.0f, 64.0f / 255.0f});
  const auto converted = [&](const std::string& out, const Words& more) {
    Words words = {tree.path("in"), "--from", "mitsuba/ggx", "--to",        "mitsuba/beckmann",
                   "--specular",    "0.04",   "-o",          tree.path(out)};
    words.insert(words.end(), more.begin(), more.end());
    require_success(convert(tree, words));
  };
  converted("plain", {});
  converted("said", {"--roughness-encoding", "roughness"});
  CHECK(texel(tree, "plain/a_Roughness.png") != texel(tree, "said/a_Roughness.png"));
  for (const char* name : {"/b_Glossiness.png", "/c_SpecularGlossiness.png", "/d_MaskMap.png"})
    CHECK(read_image(tree.path(std::string("plain") + name)).bytes ==
          read_image(tree.path(std::string("said") + name)).bytes);
}

TEST_CASE("texremap silence: there and back is the identity between workflows that hold the same", "[slow]") {
  const Tree tree;
  struct Pair {
    std::string from, to;
  };
  std::vector<Pair> pairs;
  const Words metallic = {"gltf", "usd-preview-surface", "metallic"},
              specular = {"gltf-specgloss", "specular"};
  for (const std::string& a : metallic) {
    for (const std::string& b : metallic)
      if (a != b) pairs.push_back({a, b});
    for (const std::string& b : specular) pairs.push_back({a, b});
  }
  write_flat(tree, "r.png", {0.4f});
  int checked = 0;
  for (const Pair& pair : pairs)
    for (const float is_metal : {0.0f, 1.0f}) {
      fs::remove_all(tree.path("there"));
      fs::remove_all(tree.path("back"));
      write_flat(tree, "b.png", {230.0f / 255.0f, 140.0f / 255.0f, 90.0f / 255.0f});
      write_flat(tree, "m.png", {is_metal});
      const ProcessResult there = require_success(
          convert(tree, {"--from", pair.from, "--to", pair.to, "--base-color", tree.path("b.png"),
                         "--metallic", tree.path("m.png"), "--roughness", tree.path("r.png"), "--layout",
                         "separate", "-o", tree.path("there")}));
      const bool to_specular = fs::exists(tree.path("there/specular.png"));
      const bool glossy = fs::exists(tree.path("there/glossiness.png"));
      Words words = {"--from",
                     pair.to,
                     "--to",
                     pair.from,
                     "--layout",
                     "separate",
                     "-o",
                     tree.path("back"),
                     glossy ? "--glossiness" : "--roughness",
                     tree.path(glossy ? "there/glossiness.png" : "there/roughness.png")};
      for (const char* map : {"specular", "diffuse", "base_color", "metallic"}) {
        const std::string option =
            std::string("--") + (std::string(map) == "base_color" ? "base-color" : map);
        if (fs::exists(tree.path(std::string("there/") + map + ".png")))
          words.insert(words.end(), {option, tree.path(std::string("there/") + map + ".png")});
      }
      const ProcessResult back = require_success(convert(tree, words));
      INFO(pair.from << " to " << pair.to << (to_specular ? " (specular)" : "") << ", metallic " << is_metal);
      const std::vector<int> color = texel(tree, "back/base_color.png");
      CHECK(std::abs(color[0] - 230) <= 1);
      CHECK(std::abs(color[1] - 140) <= 1);
      CHECK(std::abs(color[2] - 90) <= 1);
      CHECK(texel(tree, "back/metallic.png")[0] == static_cast<int>(255.0f * is_metal));
      CHECK(std::abs(texel(tree, "back/roughness.png")[0] - 102) <= 1);
      // What is assumed is said in the same words in both directions.
      const auto assumed = [](const std::string& errors) {
        const std::size_t begin = errors.find("warning: diffuse of ");
        return begin == std::string::npos ? "" : errors.substr(begin, errors.find('\n', begin) - begin);
      };
      const auto models_in_order = [](std::string text, const Pair& p) {
        const std::string both = p.to + " and " + p.from;
        if (const std::size_t at = text.find(both); at != std::string::npos)
          text.replace(at, both.size(), p.from + " and " + p.to);
        return text;
      };
      CHECK(models_in_order(assumed(back.errors), pair) == models_in_order(assumed(there.errors), pair));
      ++checked;
    }
  CHECK(checked == 24);
}

TEST_CASE(
    "texremap silence: metals of three.js are inside the domain, and dielectrics come back with metallic 0") {
  const Tree tree;
  const auto numbers = [&](const std::string& from, const std::string& to, const Words& more) {
    Words words = {"--from", from, "--to", to, "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const ProcessResult result = require_success(convert(tree, words));
    return nlohmann::json::parse(result.output);
  };
  for (const char* roughness : {"0.15", "0.5", "0.7", "1"}) {
    INFO("roughness " << roughness);
    const auto gold =
        numbers("threejs/standard", "gltf",
                {"--base-color", "0.944,0.776,0.373", "--metallic", "1", "--roughness", roughness});
    CHECK(gold["in_domain"] == true);
    CHECK(gold["values"]["metallic"].get<double>() == Approx(1.0).margin(0.005));
    const auto plastic =
        numbers("threejs/standard", "gltf",
                {"--base-color", "0.5,0.2,0.05", "--metallic", "0", "--roughness", roughness});
    CHECK(plastic["values"]["metallic"].get<double>() == 0.0);
    CHECK(plastic["values"]["base_color"][0].get<double>() == Approx(0.5 / 0.96).margin(1e-3));
    // Metallic between the two follows, without a jump at 0.
    const auto mixed =
        numbers("threejs/standard", "gltf",
                {"--base-color", "0.8,0.6,0.4", "--metallic", "0.02", "--roughness", roughness});
    CHECK(mixed["values"]["metallic"].get<double>() == Approx(0.02).margin(0.01));
  }
}

TEST_CASE("texremap silence: --bad-texels clamp clamps what is only passed on") {
  const Tree tree;
  write_flat(tree, "c.exr", {0.5f, 0.4f, 0.3f}, OIIO::TypeFloat);
  write_image(tree.path("r.exr"), test_spec(8, 8, kGrey, OIIO::TypeFloat), [](int x, int, int) {
    return x == 0 ? 1e38f : x == 1 ? INFINITY : x == 2 ? NAN : x == 3 ? -2.0f : 0.5f;
  });
  require_success(convert(tree, {"--from", "gltf", "--to", "usd-preview-surface", "--base-color",
                                 tree.path("c.exr"), "--metallic", "0", "--roughness", tree.path("r.exr"),
                                 "--bad-texels", "clamp", "-o", tree.path("out")}));
  const TestImage out = read_image(tree.path("out/r.exr"));
  for (int x = 0; x < 8; ++x) CHECK(out.at(x, 0, 0) == (x < 2 ? 1.0f : x < 4 ? 0.0f : 0.5f));
}
