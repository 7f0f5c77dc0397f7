// This file tests folders of texture sets, tiles and frames: the sets found, the files written, and failures
// of single sets.
#include "cli/texremap_tree.hpp"

#include <algorithm>
#include <fstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

constexpr int kSize = kTreeMapSize;
using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("texremap tree: sets of every habit are converted by the meaning of their names") {
  const Tree tree;
  tree.map("in/hero_Roughness.png", kGrey);
  tree.map("in/hero_Specular.png", kColor);
  tree.map("in/hero_Normal.png", kColor);
  tree.map("in/wood/planks_rough_4k.png", kGrey);
  tree.map("in/wood/planks_spec_4k.png", kGrey);
  tree.map("in/stone/Stone 012_2K-PNG_Roughness.png", kGrey);
  tree.map("in/quixel/abc_4K_Gloss.tga", kGrey);
  tree.map("in/quixel/abc_4K_Specular.tga", kColor);
  tree.map("in/gltf/lamp_occlusionRoughnessMetallic.png", kColor);
  tree.map("in/gltf/chair_specularGlossiness.png", kWithAlpha);
  std::ofstream(tree.path("in/notes.txt")) << "not an image";

  const ProcessResult flat = require_success(tree.convert_tree("--specular 0.04 --dry-run --json"));
  CHECK(tree_report(flat.output)["sets"].size() == 1);
  CHECK(tree.results().empty());

  const ProcessResult result = require_success(tree.convert_tree("--recursive --specular 0.04 --json"));
  CHECK(tree.results() ==
        Names{"gltf/chair_specularGlossiness.png", "gltf/lamp_occlusionRoughnessMetallic.png",
              "gltf/lamp_specular.png", "hero_Normal.png", "hero_Roughness.png", "hero_Specular.png",
              "quixel/abc_4K_Gloss.tga", "quixel/abc_4K_Specular.tga", "stone/Stone 012_2K-PNG_Roughness.png",
              "stone/Stone 012_specular.png", "wood/planks_rough_4k.png", "wood/planks_spec_4k.png"});
  const auto json = tree_report(result.output);
  REQUIRE(json["sets"].size() == 6);
  for (const auto& set : json["sets"]) {
    CHECK(set["state"] == "converted");
    CHECK(set["texels"] == kSize * kSize);
  }
  CHECK_THAT(result.errors,
             Contains("6 sets converted from mitsuba/ward to mitsuba/as in ") && Contains(" s, 0 failed"));
  CHECK_THAT(result.errors, Contains("roughness maps are read as alpha, the parameter of mitsuba/ward"));

  // Glossiness stays glossiness in the specular-glossiness set.
  const std::string name = "gltf/chair_specularGlossiness.png";
  const TestImage in = tree.image("in/" + name), out = tree.image("out/" + name);
  for (int x = 0; x < kSize; ++x) {
    const float roughness = 1.0f - in.at(x, 5, 3);
    const auto expected =
        converted_texel(roughness * roughness, {in.at(x, 5, 0), in.at(x, 5, 1), in.at(x, 5, 2)});
    CHECK(out.at(x, 5, 3) == Approx(1.0f - std::sqrt(expected[0])).margin(0.501 / 255.0));
    CHECK(out.at(x, 5, 0) == as_stored(expected[1], OIIO::TypeUInt8));
  }
}

TEST_CASE("texremap tree: a failed set does not stop the others and makes the exit code 1") {
  const Tree tree;
  tree.map("in/a_rough.png", kGrey);
  tree.map("in/a_spec.png", kGrey);
  tree.map("in/b_rough.png", kGrey);
  tree.map("in/b_spec.png", kGrey, OIIO::TypeUInt8, 2 * kSize);
  tree.map("in/c_rough.png", kGrey);
  tree.map("in/d_rough.png", kGrey);
  tree.map("in/d_Roughness.exr", kGrey, OIIO::TypeHalf);
  tree.map("in/e_rough.png", kGrey);
  tree.map("in/e_spec.png", kGrey);
  fs::resize_file(tree.path("in/e_rough.png"), fs::file_size(tree.path("in/e_rough.png")) / 2);
  tree.map("in/f_normal.png", kColor);
  const ProcessResult result = tree.convert_tree("--json");
  CHECK(result.exit_code == 1);
  CHECK(tree.results() == Names{"a_rough.png", "a_spec.png"});
  const auto json = tree_report(result.output);
  REQUIRE(json["sets"].size() == 3);
  CHECK(json["sets"][0]["state"] == "converted");
  CHECK_THAT(json["sets"][1]["failure"].get<std::string>(), Contains("size 48x48 does not match "));
  CHECK_THAT(json["sets"][2]["failure"].get<std::string>(), Contains("e_rough.png"));
  CHECK_THAT(result.errors,
             Contains("in/c: no specular map found (for sets without this map, use --specular VALUE"));
  CHECK_THAT(result.errors, Contains("2 roughness maps found: d_Roughness.exr (roughness), d_rough.png "
                                     "(roughness); keep one"));
  CHECK_THAT(result.errors, Contains("skipped: in/f: no roughness or glossiness map found"));
  CHECK_THAT(result.last_error(), Contains("4 of 6 sets failed"));
}

TEST_CASE("texremap tree: --names adds file-name habits") {
  const Tree tree;
  tree.map("in/a_zzz.png", kGrey);
  write_file(tree.path("names.json"),
             R"({"habits": [{"name": "ours", "rules": [{"words": ["zzz"], "role": "roughness"}]}]})");
  require_success(tree.convert_tree("--specular 0.04 --names names.json"));
  CHECK(tree.results() == Names{"a_specular.png", "a_zzz.png"});
}

TEST_CASE("texremap tree: the tiles of a set are one set", "[slow]") {
  const Tree tree;
  for (const char* tile : {"1001", "1002", "1011"}) {
    tree.map(std::string("in/hero_Roughness.") + tile + ".exr", kGrey, OIIO::TypeHalf);
    if (std::string(tile) != "1011")
      tree.map(std::string("in/hero_Specular.") + tile + ".exr", kColor, OIIO::TypeHalf);
  }
  const ProcessResult found = tree.convert_tree("--json");
  CHECK(found.exit_code == 1);
  const auto json = tree_report(found.output);
  REQUIRE(json["sets"].size() == 1);
  CHECK(json["sets"][0]["tiles"] == Names{"1001", "1002"});
  CHECK(json["sets"][0]["texels"] == 2 * kSize * kSize);
  CHECK_THAT(found.errors,
             Contains("hero, tile 1011: no specular map found (hero_Specular.<UDIM>.exr lacks this tile)"));
  CHECK(tree.results().size() == 4);

  // The same maps can be given by a pattern. The constant then applies to every tile.
  const ProcessResult named =
      require_success(tree.texremap("convert --from mitsuba/ward --to mitsuba/as --roughness "
                                    "in/hero_Roughness.<UDIM>.exr --specular 0.04 --json -o named"));
  CHECK(tree_report(named.output)["sets"][0]["tiles"] == Names{"1001", "1002", "1011"});
  CHECK(fs::exists(tree.path("named/hero_Roughness.1011.exr")));
  CHECK(fs::exists(tree.path("named/specular.1011.exr")));
  const ProcessResult missing = tree.texremap(
      "convert --from mitsuba/ward --to mitsuba/as --roughness in/hero_Roughness.%(UDIM)d.exr --specular "
      "in/hero_Specular.%(UDIM)d.exr -o missing");
  CHECK(missing.exit_code == 1);
  CHECK_THAT(missing.errors,
             Contains("hero_Specular.1011.exr: not found, but other maps of the set have this tile"));
  CHECK(fs::exists(tree.path("missing/hero_Specular.1002.exr")));
}

TEST_CASE("texremap tree: the number of threads changes no bit") {
  const Tree tree;
  for (int i = 0; i < 7; ++i) {
    const std::string name = "in/m" + std::to_string(i);
    tree.map(name + "_rough.exr", kGrey, OIIO::TypeHalf);
    tree.map(name + "_spec.exr", kColor, OIIO::TypeHalf);
  }
  std::vector<std::string> contents;
  for (const std::string threads : {"1", "3", "16"}) {
    require_success(tree.convert_tree("--threads " + threads + " --force"));
    std::string all;
    for (const std::string& name : tree.results()) all += tree.content("out/" + name);
    contents.push_back(all);
    CHECK(contents.back() == contents.front());
  }
  CHECK(tree.results().size() == 14);
}

TEST_CASE("texremap tree: makes only missing and changed sets", "[slow]") {
  const Tree tree;
  const std::string extension = GENERATE("exr", "png", "tif", "tga", "bmp", "jpg");
  const auto named = [&](const std::string& name) { return name + "." + extension; };
  for (const char* set : {"a", "b", "c", "d"}) {
    tree.map(named(std::string("in/") + set + "_rough"), kGrey);
    tree.map(named(std::string("in/") + set + "_spec"), kColor);
  }
  const auto states = [&](const Words& more) {
    return set_states(tree.convert_tree("--json" + more).output);
  };
  CHECK(states({}) == "cccc");
  CHECK(states({}) == "dddd");
  fs::remove(tree.path(named("out/b_spec")));
  CHECK(states({}) == "dcdd");
  // One input is faulty, another one has changed, and a result is damaged.
  tree.map(named("in/c_rough"), kColor);
  CHECK(states({}) == "ddfd");
  tree.make(named("in/c_rough"), test_spec(kSize, kSize, kGrey, OIIO::TypeUInt8),
            [](int, int, int) { return 0.5f; });
  CHECK(states({}) == "ddcd");
  CHECK(states({}) == "dddd");
  const fs::path result = tree.path(named("out/d_spec"));
  const std::string before = read_file(result);
  for (const std::string& damaged : {before.substr(0, before.size() / 2), std::string(before.size(), 'x')}) {
    write_file(result, damaged);
    CHECK(states({}) == "dddc");
    CHECK(read_file(result) == before);
  }
  // A file that no run wrote is not replaced.
  fs::remove(tree.path("out/" + std::string(kJournal)));
  CHECK(states({}) == "ffff");
  CHECK(states("--force") == "cccc");
}

TEST_CASE("texremap tree: a killed run leaves complete files, and ends like an unbroken run", "[slow]") {
  const Tree tree;
  for (int i = 0; i < 12; ++i) {
    const std::string name = "in/" + std::to_string(i);
    tree.map(name + "_rough.exr", kGrey, OIIO::TypeHalf, 256);
    tree.map(name + "_spec.exr", kColor, OIIO::TypeHalf, 256);
  }
  require_success(tree.convert_tree());
  fs::rename(tree.path("out"), tree.path("unbroken"));
  const auto check_files = [&] {
    for (const std::string& name : tree.results()) {
      if (fs::path(name).filename().string().front() == '.') continue;  // skips unfinished files
      CHECK(tree.content("out/" + name) == tree.content("unbroken/" + name));
    }
  };
  for (int kill = 0; kill < 20; ++kill) {
    if (kill % 5 == 0) fs::remove_all(tree.path("out"));
    const std::string after = "0." + std::to_string(20 + 97 * kill % 60);
    tree.run("/usr/bin/timeout -s KILL " + after + " " REMAP_TEXREMAP " " + kConversion +
             " in --color-space linear");
    check_files();
  }
  require_success(tree.convert_tree(""));
  check_files();
  std::size_t whole = 0;
  for (const std::string& name : tree.results()) whole += fs::path(name).filename().string().front() != '.';
  CHECK(whole == 24);
}

TEST_CASE("texremap tree: names with spaces, Unicode and line breaks; circular links") {
  const Tree tree;
  const std::string odd = "in/sp ace/\xc3\xbc \n\xe6\x9c\xa8";
  tree.map(odd + "_rough.png", kGrey);
  tree.map(odd + "_spec.png", kColor);
  fs::create_directory_symlink(tree.path("in"), tree.path("in/sp ace/round"));
  const ProcessResult result = require_success(tree.convert_tree("--recursive --json"));
  CHECK(tree_report(result.output)["sets"].size() == 1);
  CHECK(tree.results() == Names{odd.substr(3) + "_rough.png", odd.substr(3) + "_spec.png"});
  // A message is one line even if a name has a line break.
  for (std::size_t begin = 0; begin < result.errors.size();) {
    CHECK(result.errors.compare(begin, 10, "texremap: ") == 0);
    begin = result.errors.find('\n', begin) + 1;
    if (begin == 0) break;
  }
}
