// This file tests sets with the names from the documentation of the tools that write them, and files that
// extend the naming conventions.
#include <map>

#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "remap/error.hpp"
#include "runtime/sets/set_session.hpp"
#include "sets/naming.hpp"
#include "support/error_of.hpp"

using namespace remap;

namespace {

// Returns the convention and meaning of a name without extension: `glTF: G=roughness B=metallic`.
std::string reading_text(const std::string& name) {
  const std::vector<NameReading> readings = built_in_naming().read(name);
  if (readings.empty()) return "none";
  std::string text = readings.front().habit + ":";
  for (const ChannelMeaning& entry : readings.front().meaning) {
    text += " ";
    if (entry.channels != Channels::kWhole) text += std::string(name_of(kChannels, entry.channels)) + "=";
    text += role_name(entry.role);
  }
  return text;
}

std::string stem(const std::string& name) { return built_in_naming().read(name).at(0).stem; }

}  // namespace

TEST_CASE("Substance Painter: metal and roughness, packed as for Unreal") {
  const SetSession session{"Crate_BaseColor.png", "Crate_Normal.png", "Crate_OcclusionRoughnessMetallic.png",
                           "Crate_Emissive.png", "Crate_Height.png"};
  const Discovery found = session.find();
  const FoundSet& set = only_set(found, "Crate");
  CHECK(set.state == SetState::kReady);
  CHECK(use_text(set, set.width) == "roughness in G of Crate_OcclusionRoughnessMetallic.png");
  CHECK(use_text(set, set.specular) == "-");
  CHECK(set.maps.size() == 5);
  CHECK(reading_text("Crate_OcclusionRoughnessMetallic") ==
        "Substance Painter: R=occlusion G=roughness B=metallic");
}

TEST_CASE("Substance Painter: specular and glossiness, with UDIM tiles") {
  const SetSession session{"hero_Body_Diffuse.1001.exr",    "hero_Body_Diffuse.1002.exr",
                           "hero_Body_Specular.1001.exr",   "hero_Body_Specular.1002.exr",
                           "hero_Body_Glossiness.1001.exr", "hero_Body_Glossiness.1002.exr"};
  const Discovery found = session.find();
  const FoundSet& set = only_set(found, "hero_Body");
  CHECK(use_text(set, set.width) == "glossiness of hero_Body_Glossiness.<UDIM>.exr");
  CHECK(use_text(set, set.specular) == "specular of hero_Body_Specular.<UDIM>.exr");
  CHECK(set.maps[0].habit == "Substance Painter");
  CHECK(set.maps[0].tiles ==
        Tiles{{1001, "hero_Body_Glossiness.1001.exr"}, {1002, "hero_Body_Glossiness.1002.exr"}});
}

TEST_CASE("Substance Painter: its presets for renderers and engines") {
  CHECK(reading_text("m_SpecularRoughness") == "Substance Painter: roughness");
  CHECK(reading_text("m_SpecularFaceColor") == "Substance Painter: specular");
  CHECK(reading_text("m_ReflectionGlossiness") == "Substance Painter: glossiness_squared");
  CHECK(reading_text("m_MaskMap") == "Substance Painter: R=metallic G=occlusion A=glossiness");
  CHECK(reading_text("m_Base_color") == "Substance Painter: base_color");
  CHECK(reading_text("m_Mixed_AO") == "Substance Painter: occlusion");
  CHECK(reading_text("m_Normal_OpenGL") == "Substance Painter: normal");
  CHECK(reading_text("monkey_DefaultMaterial_BaseColor_sRGB") == "Substance Painter: base_color");
  CHECK(stem("monkey_DefaultMaterial_BaseColor_sRGB") == "monkey_DefaultMaterial");
}

TEST_CASE("Substance Painter: a tile before the word") {
  const SetSession session{"robot_1001_Roughness.png", "robot_1002_Roughness.png", "robot_1001_BaseColor.png",
                           "robot_1002_BaseColor.png"};
  const Discovery found = session.find();
  const FoundSet& set = only_set(found, "robot");
  CHECK(use_text(set, set.width) == "roughness of robot_<UDIM>_Roughness.png");
}

TEST_CASE("Poly Haven: maps with the resolution after the word") {
  const SetSession session{"rocky_terrain_02_diff_4k.jpg", "rocky_terrain_02_rough_4k.exr",
                           "rocky_terrain_02_spec_4k.png", "rocky_terrain_02_nor_gl_4k.exr",
                           "rocky_terrain_02_disp_4k.png", "rocky_terrain_02_ao_4k.jpg"};
  const Discovery found = session.find();
  const FoundSet& set = only_set(found, "rocky_terrain_02");
  CHECK(use_text(set, set.width) == "roughness of rocky_terrain_02_rough_4k.exr");
  CHECK(use_text(set, set.specular) == "specular of rocky_terrain_02_spec_4k.png");
  CHECK(set.maps[0].habit == "Poly Haven");
  CHECK(set.maps.size() == 6);
  CHECK(reading_text("brick_arm_4k") == "Poly Haven: R=occlusion G=roughness B=metallic");
  CHECK(reading_text("red_brick_03_nor_dx_2k") == "Poly Haven: normal");
}

TEST_CASE("Poly Haven: rough_ao packs roughness and occlusion", "[reports]") {
  const SetSession session{"old_bench_diff_1k.jpg", "old_bench_nor_1k.jpg", "old_bench_rough_ao_1k.jpg"};
  const FoundSet set = only_set(session.find(), "old_bench");
  CHECK(set.maps.size() == 3);
  CHECK(reading_text("old_bench_rough_ao_1k") == "Poly Haven: R=roughness G=occlusion");
  CHECK(reading_text("rusty_metal_rough_ao_2k") == "renderers: R=metallic G=roughness B=occlusion");
  // If the name of a set ends with such a word, the other maps show where the name ends.
  const SetSession metal{"rusty_metal_diff_2k.jpg", "rusty_metal_rough_ao_2k.jpg",
                         "rusty_metal_nor_gl_2k.jpg"};
  CHECK(only_set(metal.find(), "rusty_metal").maps.size() == 3);
  const SetSession rough{"dark_rough_diff_2k.jpg", "dark_rough_ao_2k.jpg", "dark_rough_rough_2k.jpg"};
  CHECK(only_set(rough.find(), "dark_rough").maps.size() == 3);
}

TEST_CASE("packed maps: words and channels have the same order", "[reports]") {
  const auto meaning = [](const std::string& name) {
    const std::string text = reading_text(name);
    return text.substr(text.find(": ") + 2);
  };
  CHECK(meaning("rock_ao_rough_metal_2k") == "R=occlusion G=roughness B=metallic");
  CHECK(meaning("rock_AoRoughMetal") == "R=occlusion G=roughness B=metallic");
  CHECK(meaning("rock_roughness_metallic_ao") == "R=roughness G=metallic B=occlusion");
  CHECK(meaning("rock_MetalRoughAO") == "R=metallic G=roughness B=occlusion");
  CHECK(meaning("rock_metallic_occlusion_roughness") == "R=metallic G=occlusion B=roughness");
  CHECK(meaning("T_rock_2K_ORDp") == "R=occlusion G=roughness B=height");
  CHECK(meaning("rock_MADS") == "R=metallic G=occlusion A=glossiness");
  CHECK(meaning("rock_normal-ogl") == "normal");
}

TEST_CASE("ambientCG: resolution and format before the word") {
  const SetSession session{"Metal014_4K-PNG_Color.png",     "Metal014_4K-PNG_NormalGL.png",
                           "Metal014_4K-PNG_NormalDX.png",  "Metal014_4K-PNG_Roughness.png",
                           "Metal014_4K-PNG_Metalness.png", "Metal014_4K-PNG_Displacement.png"};
  const Discovery found = session.find();
  const FoundSet& set = only_set(found, "Metal014");
  CHECK(use_text(set, set.width) == "roughness of Metal014_4K-PNG_Roughness.png");
  CHECK(set.maps[0].habit == "ambientCG");
  CHECK(set.maps.size() == 6);
  CHECK(reading_text("Chainmail004_1K-JPG_AmbientOcclusion") == "ambientCG: occlusion");
  CHECK(reading_text("Metal08_rgh").ends_with(": roughness"));
  CHECK(stem("3DBread005_2K-HQ_Color") == "3DBread005");
}

TEST_CASE("Quixel Megascans: resolution before the word") {
  const SetSession session{"vhqgdhh_4K_Albedo.jpg", "vhqgdhh_4K_Specular.jpg", "vhqgdhh_4K_Gloss.jpg",
                           "vhqgdhh_4K_Cavity.jpg", "vhqgdhh_4K_Normal.jpg",   "vhqgdhh_4K_Displacement.exr"};
  const Discovery found = session.find();
  const FoundSet& set = only_set(found, "vhqgdhh");
  CHECK(use_text(set, set.width) == "glossiness of vhqgdhh_4K_Gloss.jpg");
  CHECK(use_text(set, set.specular) == "specular of vhqgdhh_4K_Specular.jpg");
  CHECK(set.maps[0].habit == "Quixel Megascans");
  CHECK(set.maps[1].habit == "Quixel Megascans");
  CHECK(reading_text("okdr22_4K_Roughness") == "Quixel Megascans: roughness");
}

TEST_CASE("glTF: packed maps of its two material models") {
  const SetSession session{"BoomBox_baseColor.png", "BoomBox_occlusionRoughnessMetallic.png",
                           "Robot_diffuse.png", "Robot_specularGlossiness.png", "Default_metalRoughness.jpg"};
  const Discovery found = session.find();
  REQUIRE(found.sets.size() == 3);
  const FoundSet& robot = set_at(found, "Robot");
  CHECK(use_text(robot, robot.width) == "glossiness in A of Robot_specularGlossiness.png");
  CHECK(use_text(robot, robot.specular) == "specular in RGB of Robot_specularGlossiness.png");
  REQUIRE(robot.maps.size() == 2);
  CHECK(robot.maps[0].is_converted);
  CHECK_FALSE(robot.maps[1].is_converted);
  const FoundSet& box = set_at(found, "BoomBox");
  CHECK(use_text(box, box.width) == "roughness in G of BoomBox_occlusionRoughnessMetallic.png");
  CHECK(box.maps[0].habit == "glTF");
  CHECK(reading_text("Default_metalRoughness") == "glTF: G=roughness B=metallic");
  CHECK(reading_text("Fox_metallicRoughness") == "glTF: G=roughness B=metallic");
  CHECK(reading_text("Fox_Roughness_Metallic") == "glTF: G=roughness B=metallic");
  CHECK(reading_text("T_Crate_Worn_ORM") == "glTF: R=occlusion G=roughness B=metallic");
}

TEST_CASE("Mari: the channel is the whole name or its end") {
  const SetSession session{"diffuse.1001.exr",
                           "specRough.1001.exr",
                           "spec.1001.exr",
                           "props/barbarian_specularColor.1001.exr",
                           "props/barbarian_specRough.1001.exr",
                           "props/tableTopSpecular.tif",
                           "props/tableTopRoughness.tif"};
  const Discovery found = session.find();
  REQUIRE(found.sets.size() == 3);
  const FoundSet& whole = set_at(found, session.root().filename().string());
  CHECK(whole.folder.empty());
  CHECK(use_text(whole, whole.width) == "roughness of specRough.<UDIM>.exr");
  CHECK(use_text(whole, whole.specular) == "specular of spec.<UDIM>.exr");
  CHECK(whole.maps[0].habit == "Mari");
  const FoundSet& barbarian = set_at(found, "props/barbarian");
  CHECK(use_text(barbarian, barbarian.specular) == "specular of props/barbarian_specularColor.<UDIM>.exr");
  const FoundSet& table = set_at(found, "props/tableTop");
  CHECK(use_text(table, table.width) == "roughness of props/tableTopRoughness.tif");
}

TEST_CASE("renderers: short words") {
  const SetSession session{"wood_rgh.tx", "wood_spc.tx", "steel_gls.tif", "steel_refl.tif"};
  const Discovery found = session.find();
  REQUIRE(found.sets.size() == 2);
  const FoundSet& wood = set_at(found, "wood");
  CHECK(use_text(wood, wood.width) == "roughness of wood_rgh.tx");
  CHECK(use_text(wood, wood.specular) == "specular of wood_spc.tx");
  const FoundSet& steel = set_at(found, "steel");
  CHECK(use_text(steel, steel.width) == "glossiness of steel_gls.tif");
  CHECK(use_text(steel, steel.specular) == "specular of steel_refl.tif");
}

TEST_CASE("read name: case and separators are ignored") {
  for (const std::string name :
       {"a_base_color", "a-Base-Color", "a BASE COLOR", "a.basecolor", "a_baseColor"})
    CHECK(built_in_naming().read(name).at(0).meaning ==
          std::vector<ChannelMeaning>{{Channels::kWhole, Role::kBaseColor}});
  for (const std::string name :
       {"a_ROUGHNESS", "a-roughness", "a roughness 2K", "a.Rough.2048x2048", "a_1024_rough"})
    CHECK(reading_text(name).ends_with(": roughness"));
  CHECK(stem("a_1024_rough") == "a");
}

TEST_CASE("read name: words inside other words and names of sets do not count") {
  for (const std::string name : {"spectrum", "glossary", "through", "a_spectrum", "arms", "armchair_",
                                 "normalized_2k", "trough", "4k", "", "_", "1024"})
    CHECK(reading_text(name) == "none");
  // A word at the start only has a meaning if another map has the same stem.
  for (const std::string name : {"color_chart", "rough_sketch"})
    CHECK(built_in_naming().read(name).front().doubtful);
  CHECK(reading_text("rough_wood_diff_2k") == "Poly Haven: diffuse");
  CHECK(stem("rough_wood_diff_2k") == "rough_wood");
  CHECK(stem("glossy_tiles_Roughness") == "glossy_tiles");
  // A capital begins a word only for conventions with `camel_case`.
  CHECK(reading_text("heroArm") == "none");
  CHECK(reading_text("heroSpecRough") == "Mari: roughness");
  CHECK(reading_text("rusty_metal_rough_4k") == "Poly Haven: roughness");
  CHECK(reading_text("rusty_metal_roughness").ends_with(": roughness"));
}

TEST_CASE("read name: the roughness of a coat is not the roughness of the base") {
  for (const std::string name : {"car_CoatRoughness", "car_coat_roughness", "car_clearcoatRoughness",
                                 "car_sheen_roughness", "car_diffuseRoughness"})
    CHECK(reading_text(name).ends_with(": other"));
}

TEST_CASE("built-in habits: one word means the same in all of them") {
  std::map<std::string, std::vector<ChannelMeaning>> meanings;
  for (const Habit& habit : built_in_naming().habits()) {
    CHECK(habit.built_in);
    for (const NamingRule& rule : habit.rules) {
      for (const std::string& word : rule.words) {
        INFO(habit.name << ": " << word);
        const auto [entry, added] = meanings.try_emplace(word_key(word), rule.meaning);
        CHECK(entry->second == rule.meaning);
      }
    }
  }
}

TEST_CASE("built-in habits: every word is read as its rule says") {
  for (const Habit& habit : built_in_naming().habits()) {
    for (const NamingRule& rule : habit.rules) {
      for (const std::string& word : rule.words) {
        INFO(habit.name << ": " << word);
        const std::vector<NameReading> readings = built_in_naming().read("thing_" + word);
        REQUIRE_FALSE(readings.empty());
        CHECK(readings.front().meaning == rule.meaning);
        CHECK(readings.front().stem == "thing");
      }
    }
  }
}

TEST_CASE("read name: versions at the end, roles in front, and Blender's pair of packed maps") {
  CHECK(reading_text("Robot_Roughness_v001") == "Substance Painter: roughness");
  CHECK(stem("Robot_Roughness_v001") == "Robot");
  CHECK(stem("Robot_2K_Gloss_v2") == "Robot");
  CHECK(stem("ROUGHNESS_Robot") == "Robot");
  CHECK(built_in_naming().read("ROUGHNESS_Robot").front().doubtful);
  CHECK(reading_text("Robot Metallic-Robot Roughness") == "glTF: G=roughness B=metallic");
  CHECK(stem("Robot Metallic-Robot Roughness") == "Robot");
  CHECK(reading_text("Robot Metallic-Chair Roughness") == "Substance Painter: roughness");
  CHECK(reading_text("vases_v2") == "none");

  const SetSession front{"ROUGHNESS_Robot.png", "METALLIC_Robot.png", "BaseColor_Robot.png", "rough_cut.png"};
  const Discovery found = front.find();
  CHECK(only_set(found, "Robot").maps.size() == 3);
  CHECK(found.unrecognised.size() == 1);
}

namespace {

std::string complaint(const std::string& text) {
  return error_of([&] { parse_naming(text, "names.json"); }, ErrorKind::kInput);
}

// Returns a file with one convention that has one rule.
std::string with_rule(const std::string& rule) {
  return R"({"habits": [{"name": "x", "rules": [)" + rule + "]}]}";
}

}  // namespace

TEST_CASE("naming file: its words extend the built-in ones and take precedence") {
  const Naming naming = parse_naming(R"({
    "habits": [{"name": "ours", "camel_case": true, "resolution": "after", "rules": [
      {"words": ["srgh"], "role": "roughness"},
      {"words": ["arm"], "channels": {"R": "alpha_width", "G": "other", "B": "metallic"}}]}],
    "ignored_words": ["graded"]})",
                                     "names.json");
  CHECK(naming.read("a_srgh_2k").at(0).habit == "ours");
  CHECK(naming.read("aSrgh_graded").at(0).stem == "a");
  CHECK(naming.read("a_arm_2k").at(0).habit == "ours");
  CHECK(naming.read("a_arm_2k").at(0).meaning.at(0) == ChannelMeaning{Channels::kRed, Role::kAlphaWidth});
  CHECK(naming.read("a_Roughness").at(0).habit == "Substance Painter");
  CHECK(built_in_naming().read("a_srgh").empty());
}

TEST_CASE("naming file: is used by a search for sets") {
  const SetSession session{"wall_matt.png", "wall_shine.png"};
  write_file(session.root() / "names.json", R"({"habits": [{"name": "ours", "rules": [
    {"words": ["matt"], "role": "roughness"}, {"words": ["shine"], "role": "specular"}]}]})");
  CHECK(session.find().sets.empty());
  const Naming naming = read_naming(session.root() / "names.json");
  const Discovery found = find_sets(session.root(), {}, naming);
  const FoundSet& set = set_at(found, "wall");
  CHECK(use_text(set, set.width) == "roughness of wall_matt.png");
  CHECK(use_text(set, set.specular) == "specular of wall_shine.png");
}

TEST_CASE("naming file: errors name the field and the expected value") {
  CHECK(complaint("[") != "");
  CHECK(complaint("[]") == "names.json: expected an object, found []");
  CHECK(complaint("{}") == "names.json: has no field \"habits\"");
  CHECK(complaint(R"({"habits": []})") ==
        "names.json: habits: expected a list of at least 1 entry, found []");
  CHECK(complaint(R"({"habit": []})") == "names.json: unknown field 'habit' (did you mean habits?)");
  CHECK(complaint(with_rule(R"({"words": ["a"], "role": "rougness"})")) ==
        "names.json: habits[0].rules[0].role: unknown role 'rougness' (did you mean roughness?)");
  CHECK(complaint(with_rule(R"({"words": ["a"], "channels": {"X": "roughness"}})"))
            .find("channels: unknown field 'X'") != std::string::npos);
  CHECK(complaint(with_rule(R"({"words": [], "role": "roughness"})")) ==
        "names.json: habits[0].rules[0].words: expected a list of at least 1 entry, found []");
  CHECK(complaint(with_rule(R"({"words": ["_"], "role": "roughness"})")) ==
        "names.json: habits[0].rules[0].words[0]: expected a word, found \"_\"");
  CHECK(complaint(with_rule(R"({"words": ["4K"], "role": "roughness"})")).find("neither a resolution") !=
        std::string::npos);
  CHECK(complaint(with_rule(R"({"words": ["PNG"], "role": "roughness"})")).find("nor a format") !=
        std::string::npos);
  CHECK(complaint(R"({"habits": [{"name": "", "rules": [{"words": ["a"], "role": "ior"}]}]})") ==
        "names.json: habits[0].name: expected a name, found \"\"");
  CHECK(complaint(
            R"({"habits": [{"name": "x", "resolution": "aftr",
      "rules": [{"words": ["a"], "role": "ior"}]}]})") ==
        "names.json: habits[0].resolution: unknown place of a resolution 'aftr' (did you mean after?)");
  CHECK(complaint(R"({"habits": [{"name": "x", "camel_case": 1,
                             "rules": [{"words": ["a"], "role": "ior"}]}]})") ==
        "names.json: habits[0].camel_case: expected true or false, found 1");
  CHECK(complaint(with_rule(R"({"words": ["a"], "ordinary": "no", "role": "ior"})")) ==
        "names.json: habits[0].rules[0].ordinary: expected true or false, found \"no\"");
}

TEST_CASE("naming file: a longer word of the built-in habits wins over its words") {
  const Naming naming = parse_naming(with_rule(R"({"words": ["color"], "role": "specular"})"), "names.json");
  CHECK(naming.read("a_Base_Color").at(0).meaning.at(0).role == Role::kBaseColor);
  CHECK(naming.read("a_Color").at(0).meaning.at(0).role == Role::kSpecular);
}

TEST_CASE("naming file: rules that contradict themselves are refused") {
  CHECK(complaint(with_rule(R"({"words": ["a"]})")).find("expected either \"role\" or \"channels\"") !=
        std::string::npos);
  CHECK(complaint(with_rule(R"({"words": ["a"], "role": "ior", "channels": {"R": "ior"}})"))
            .find("expected either \"role\" or \"channels\"") != std::string::npos);
  CHECK(complaint(with_rule(R"({"words": ["a"], "channels": {"RGB": "specular", "R": "ior"}})"))
            .find("expected RGB or its channels one by one") != std::string::npos);
  CHECK(complaint(with_rule(R"({"words": ["a"], "channels": {"R": "roughness", "A": "glossiness"}})"))
            .find("expected at most one of roughness, glossiness and alpha_width") != std::string::npos);
  CHECK(complaint(with_rule(R"({"words": ["a"], "channels": {"R": "specular", "G": "specular"}})"))
            .find("expected specular at most once") != std::string::npos);
  CHECK(complaint(with_rule(R"({"words": ["a_b"], "role": "ior"}, {"words": ["A-B"], "role": "height"})")) ==
        "names.json: habits[0]: two rules for the word 'ab' (keep one)");
  CHECK(complaint(with_rule(R"({"words": ["a_b", "aB"], "role": "ior"})")) == "");
}

TEST_CASE("naming file: a missing file is an error") {
  CHECK_THROWS_AS(read_naming("no/such/names.json"), Error);
}
