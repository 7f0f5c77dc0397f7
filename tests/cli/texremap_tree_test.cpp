// This file tests folders of texture sets, tiles and frames: the sets found, the files written, maps that
// are copied byte for byte, and failures of single sets.
#include <algorithm>
#include <fstream>

#include <catch2/catch.hpp>

#include "cli/texremap_session.hpp"

using namespace remap;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

TEST_CASE("texremap tree: sets of every habit are converted by the meaning of their names") {
  const Session tree;
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
    CHECK(set["texels"] == kMapSize * kMapSize);
  }
  CHECK_THAT(result.errors,
             Contains("6 sets converted from mitsuba/ward to mitsuba/as in ") && Contains(" s, 0 failed"));
  CHECK_THAT(result.errors, Contains("roughness maps are read as alpha, the parameter of mitsuba/ward"));

  // Glossiness stays glossiness in the specular-glossiness set.
  const std::string name = "gltf/chair_specularGlossiness.png";
  const TestImage in = tree.image("in/" + name), out = tree.image("out/" + name);
  for (int x = 0; x < kMapSize; ++x) {
    const float roughness = 1.0f - in.at(x, 5, 3);
    const auto expected =
        converted_texel(roughness * roughness, {in.at(x, 5, 0), in.at(x, 5, 1), in.at(x, 5, 2)});
    CHECK(out.at(x, 5, 3) == Approx(1.0f - std::sqrt(expected[0])).margin(0.501 / 255.0));
    CHECK(out.at(x, 5, 0) == as_stored(expected[1], OIIO::TypeUInt8));
  }
}

TEST_CASE("texremap tree: a failed set does not stop the others and makes the exit code 1") {
  const Session tree;
  for (const char* set : {"a", "b", "e"}) tree.write_set(std::string("in/") + set, "png");
  tree.map("in/b_spec.png", kGrey, OIIO::TypeUInt8, 2 * kMapSize);
  for (const char* set : {"c", "d"}) tree.map(std::string("in/") + set + "_rough.png", kGrey);
  tree.map("in/d_Roughness.exr", kGrey, OIIO::TypeHalf);
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
  const Session tree;
  tree.map("in/a_zzz.png", kGrey);
  write_file(tree.path("names.json"),
             R"({"habits": [{"name": "ours", "rules": [{"words": ["zzz"], "role": "roughness"}]}]})");
  require_success(tree.convert_tree("--specular 0.04 --names names.json"));
  CHECK(tree.results() == Names{"a_specular.png", "a_zzz.png"});
}

TEST_CASE("texremap tree: the tiles of a set are one set", "[slow]") {
  const Session tree;
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
  CHECK(json["sets"][0]["texels"] == 2 * kMapSize * kMapSize);
  CHECK_THAT(found.errors,
             Contains("hero, tile 1011: no specular map found (hero_Specular.<UDIM>.exr lacks this tile)"));
  CHECK(tree.results().size() == 4);

  // The same maps can be given by a pattern. The constant then applies to every tile.
  const ProcessResult named =
      require_success(tree.texremap("convert --from mitsuba/ward --to mitsuba/as --roughness "
                                    "in/hero_Roughness.<UDIM>.exr --specular 0.04 --json -o named"));
  CHECK(tree_report(named.output)["sets"][0]["tiles"] == Names{"1001", "1002", "1011"});
  CHECK(tree.exists("named/hero_Roughness.1011.exr"));
  CHECK(tree.exists("named/specular.1011.exr"));
  const ProcessResult missing = tree.texremap(
      "convert --from mitsuba/ward --to mitsuba/as --roughness in/hero_Roughness.%(UDIM)d.exr --specular "
      "in/hero_Specular.%(UDIM)d.exr -o missing");
  CHECK(missing.exit_code == 1);
  CHECK_THAT(missing.errors,
             Contains("hero_Specular.1011.exr: not found, but other maps of the set have this tile"));
  CHECK(tree.exists("missing/hero_Specular.1002.exr"));
}

TEST_CASE("texremap tree: the number of threads changes no bit") {
  const Session tree;
  for (int i = 0; i < 7; ++i) tree.write_set("in/m" + std::to_string(i), "exr", OIIO::TypeHalf);
  require_success(tree.convert_tree("--threads 1"));
  const auto one = tree.contents();
  CHECK(one.size() == 14);
  for (const std::string threads : {"3", "16"}) {
    require_success(tree.convert_tree("--threads " + threads + " --force"));
    CHECK(tree.contents() == one);
  }
}

TEST_CASE("texremap tree: makes only missing and changed sets", "[slow]") {
  const Session tree;
  const std::string extension = GENERATE("exr", "png", "tif", "tga", "bmp", "jpg");
  const auto named = [&](const std::string& name) { return name + "." + extension; };
  for (const char* set : {"a", "b", "c", "d"}) tree.write_set(std::string("in/") + set, extension);
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
  tree.flat(named("in/c_rough"), {0.5f});
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
  const Session tree;
  for (int i = 0; i < 12; ++i) tree.write_set("in/" + std::to_string(i), "exr", OIIO::TypeHalf, 256);
  require_success(tree.convert_tree());
  const auto unbroken = tree.contents();
  // Compares the finished files, and returns their number.
  const auto check_files = [&] {
    std::size_t whole = 0;
    for (const auto& [name, content] : tree.contents()) {
      if (name.starts_with('.')) continue;
      ++whole;
      CHECK(content == unbroken.at(name));
    }
    return whole;
  };
  for (int kill = 0; kill < 20; ++kill) {
    if (kill % 5 == 0) fs::remove_all(tree.path("out"));
    const std::string after = "0." + std::to_string(20 + 97 * kill % 60);
    tree.run("/usr/bin/timeout -s KILL " + after + " " REMAP_TEXREMAP " " + kConversion +
             " in --color-space linear");
    check_files();
  }
  require_success(tree.convert_tree());
  CHECK(check_files() == 24);
}

TEST_CASE("texremap tree: names with spaces, Unicode and line breaks; circular links") {
  const Session tree;
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

namespace {

// Writes a whole material: maps to convert and maps to copy.
void write_wood(const Session& session, const std::string& folder = "in") {
  for (const char* map : {"Roughness", "AmbientOcclusion"})
    session.map(folder + "/wood_" + map + ".png", kGrey);
  for (const char* map : {"Specular", "Normal"}) session.map(folder + "/wood_" + map + ".png", kColor);
  session.map(folder + "/wood_BaseColor.png", kWithAlpha, OIIO::TypeUInt8, 2 * kMapSize);
}

ProcessResult convert_copies(const Session& session, Words words) {
  return session.texremap(Words("convert") + words + "--from mitsuba/ward --to mitsuba/as -o out");
}

bool same_bytes(const Session& session, const std::string& a, const std::string& b) {
  return session.content(a) == session.content(b);
}

}  // namespace

TEST_CASE("texremap copies: base color of any size is copied under its name") {
  const Session session;
  write_wood(session);
  const ProcessResult result = require_success(
      convert_copies(session,
                     "--roughness in/wood_Roughness.png --specular 0.04 --only roughness --base-color "
                     "in/wood_BaseColor.png --input occlusion=in/wood_AmbientOcclusion.png --json"));
  CHECK(session.file_count() == 3);
  CHECK(same_bytes(session, "in/wood_BaseColor.png", "out/wood_BaseColor.png"));
  CHECK(same_bytes(session, "in/wood_AmbientOcclusion.png", "out/wood_AmbientOcclusion.png"));
  CHECK(nlohmann::json::parse(result.output).at("copies").size() == 2);
}

TEST_CASE("texremap copies: layouts that name their files name the copies, too", "[slow]") {
  const Session session;
  write_wood(session);
  const std::string layout = GENERATE("separate", "orm", "specgloss");
  const std::string option = GENERATE("--diffuse", "--base-color");
  require_success(
      convert_copies(session, "--roughness in/wood_Roughness.png --specular in/wood_Specular.png " + option +
                                  " in/wood_BaseColor.png --layout " + layout));
  const std::string name = option == "--diffuse" ? "diffuse" : "base_color";
  CHECK(same_bytes(session, "in/wood_BaseColor.png", "out/" + name + ".png"));
}

TEST_CASE("texremap copies: specgloss writes separate files for parameters without a channel") {
  const Session session;
  write_wood(session);
  require_success(
      convert_copies(session,
                     "--roughness in/wood_Roughness.png --specular in/wood_Specular.png --input occlusion="
                     "in/wood_AmbientOcclusion.png --metallic 0.5 --layout specgloss"));
  CHECK(session.file_count() == 3);
  const TestImage occlusion = session.image("in/wood_AmbientOcclusion.png"),
                  copied = session.image("out/occlusion.png"), metallic = session.image("out/metallic.png");
  CHECK(copied.at(3, 5, 0) == occlusion.at(3, 5, 0));
  CHECK(metallic.at(3, 5, 0) == as_stored(0.5f, OIIO::TypeUInt8));
}

TEST_CASE("texremap copies: a tree with all maps is copied and resumed", "[slow]") {
  const Session session;
  write_wood(session, "in/a");
  write_wood(session, "in/b/c");
  const Words words = "in --recursive ";
  require_success(convert_copies(session, words));
  for (const std::string folder : {"a", "b/c"}) {
    for (const std::string map : {"BaseColor", "Normal", "AmbientOcclusion"}) {
      const std::string name = folder + "/wood_" + map + ".png";
      CHECK(same_bytes(session, "in/" + name, "out/" + name));
    }
    CHECK_FALSE(
        same_bytes(session, "in/" + folder + "/wood_Roughness.png", "out/" + folder + "/wood_Roughness.png"));
  }

  const auto states = [&] {
    return set_states(require_success(convert_copies(session, words + "--json")).output);
  };
  CHECK(states() == "dd");
  fs::remove(session.path("out/a/wood_Normal.png"));
  CHECK(states() == "cd");
  session.map("in/b/c/wood_Normal.png", kColor, OIIO::TypeUInt8, 2 * kMapSize);
  CHECK(states() == "dc");
  for (const char* name : {"a/wood_Normal.png", "b/c/wood_Normal.png"})
    CHECK(same_bytes(session, std::string("in/") + name, std::string("out/") + name));
}

TEST_CASE("texremap copies: a packed map is not copied as well") {
  const Session session;
  write_wood(session);
  require_success(convert_copies(session, "in --layout orm"));
  CHECK(session.exists(("out/wood_orm.png")));
  CHECK(session.exists(("out/wood_Normal.png")));
  CHECK_FALSE(session.exists(("out/wood_AmbientOcclusion.png")));
}

TEST_CASE("texremap copies: each tile copies the same tile of other maps") {
  const Session session;
  for (const std::string tile : {"1001", "1002"}) {
    session.map("r." + tile + ".png", kGrey);
    session.map("ao." + tile + ".png", kGrey);
    session.map("d." + tile + ".png", kColor);
  }
  require_success(
      convert_copies(session,
                     "--roughness r.<UDIM>.png --specular 0.04 --input occlusion=ao.<UDIM>.png --diffuse "
                     "d.<UDIM>.png --layout orm"));
  CHECK(same_bytes(session, "d.1002.png", "out/diffuse.1002.png"));
  CHECK(session.image("out/orm.1002.png").at(2, 3, 0) == session.image("ao.1002.png").at(2, 3, 0));
}

TEST_CASE(
    "texremap copies: a preset turns green of normal maps whose names say that it points the other way") {
  const Session session;
  for (const std::string name :
       {"wood_BaseColor.png", "wood_Normal_OpenGL.png", "tin_BaseColor.png", "tin_Normal.png",
        "oak_BaseColor.png", "oak_NormalGL.png", "oak_NormalDX.png"})
    session.map("in/" + name, kColor);
  for (const std::string set : {"wood", "tin", "oak"})
    for (const std::string map : {"Roughness", "Metallic"})
      session.map("in/" + set + "_" + map + ".png", kGrey);
  const Words words = "convert in --from metallic --to";
  const ProcessResult down = require_success(session.texremap(words + "unreal -o unreal"));
  CHECK_THAT(
      down.errors,
      Contains("wood_Normal_OpenGL.png: green is inverted in the copy wood_Normal_DirectX.png, because "
               "its name means OpenGL (green up), but unreal reads DirectX (green down)") &&
          Contains("tin_Normal.png: green is kept, because neither the file name nor --from shows"));
  CHECK_FALSE(session.exists(("unreal/wood_Normal_OpenGL.png")));
  const TestImage before = session.image("in/wood_Normal_OpenGL.png"),
                  after = session.image("unreal/wood_Normal_DirectX.png");
  CHECK(after.at(3, 5, 0) == before.at(3, 5, 0));
  CHECK(after.at(3, 5, 1) == Approx(1.0f - before.at(3, 5, 1)));
  CHECK(same_bytes(session, "in/tin_Normal.png", "unreal/tin_Normal.png"));
  for (const std::string name : {"oak_NormalGL.png", "oak_NormalDX.png"})
    CHECK(same_bytes(session, "in/" + name, "unreal/" + name));

  const ProcessResult up = require_success(session.texremap(words + "gltf -o gltf"));
  CHECK_THAT(up.errors, !Contains("inverted"));
  CHECK(same_bytes(session, "in/wood_Normal_OpenGL.png", "gltf/wood_Normal_OpenGL.png"));
  CHECK_THAT(require_success(session.texremap(words + "unreal -o planned --dry-run")).output,
             Contains("green inverted"));
}
