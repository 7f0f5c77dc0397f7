// This file tests the discovery of sets in typical trees, and in trees with errors: patterns of tiles and
// frames, and tiles that are recognised without a pattern.
#include <chrono>
#include <fstream>
#include <iostream>
#include <random>
#include <set>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "remap/error.hpp"
#include "runtime/sets/set_session.hpp"
#include "sets/tiles.hpp"
#include "support/error_of.hpp"
#include "support/shared_data.hpp"
#include "support/skip.hpp"
#include "support/temporary_folder.hpp"

using namespace remap;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> set_paths(const Discovery& discovery) {
  std::vector<std::string> paths;
  for (const FoundSet& set : discovery.sets) paths.push_back((set.folder / set.name).string());
  return paths;
}

// Acts as an ordinary user during its lifetime, because root can read everything.
class OrdinaryUser {
 public:
  OrdinaryUser() : changed_(::geteuid() == 0 && ::seteuid(65534) == 0) {}
  ~OrdinaryUser() {
    if (changed_ && ::seteuid(0) != 0) std::abort();
  }
  OrdinaryUser(const OrdinaryUser&) = delete;
  OrdinaryUser& operator=(const OrdinaryUser&) = delete;

 private:
  bool changed_ = false;
};

}  // namespace

TEST_CASE("find sets: several in a folder and in a tree, in the order of their paths") {
  const SetSession session{"b_rough.png",   "a_rough.png",   "a_spec.png",
                           "z/a_rough.png", "a/x_rough.png", "a/deep/er/y_rough.png",
                           "notes.txt",     "glossary.txt",  "spectrum.png"};
  const Discovery found = session.find();
  CHECK(set_paths(found) == std::vector<std::string>{"a", "a/deep/er/y", "a/x", "b", "z/a"});
  CHECK(found.unrecognised == std::vector<fs::path>{"spectrum.png"});
  CHECK(found.problems.empty());
  WalkOptions flat;
  flat.recursive = false;
  CHECK(set_paths(session.find(flat)) == std::vector<std::string>{"a", "b"});
  WalkOptions excluding;
  excluding.excluded = {session.root() / "z", session.root() / "a/../a/deep", session.root() / "none"};
  CHECK(set_paths(session.find(excluding)) == std::vector<std::string>{"a", "a/x", "b"});
}

TEST_CASE("find sets: images by extension, ignoring case") {
  const SetSession session{"a_rough.EXR", "b_rough.tif", "c_rough.TIFF", "d_rough.Jpg",  "e_rough.jpeg",
                           "f_rough.tga", "g_rough.bmp", "h_rough.hdr",  "i_rough.tx",   "j_rough.png",
                           "k_rough.txt", "l_rough",     "m_rough.psd",  "n_rough.json", "o_rough.png.bak"};
  CHECK(set_paths(session.find()) ==
        std::vector<std::string>{"a", "b", "c", "d", "e", "f", "g", "h", "i", "j"});
}

TEST_CASE("find sets: hidden files and unfinished results are skipped") {
  const SetSession session{".a_rough.png", ".hidden/b_rough.png", "c_rough.png"};
  session.add(unfinished_name("d_rough.png").string());
  CHECK(set_paths(session.find()) == std::vector<std::string>{"c"});
}

TEST_CASE("find sets: two candidates for a role make only their set faulty") {
  const SetSession session{"a_rough.png",    "a_Roughness.exr", "b_roughness.png", "b_glossiness.png",
                           "c_orm.png",      "c_roughness.png", "d_rough.png",     "d_spec.png",
                           "d_specular.exr", "e_rough.png",     "f_rough_2k.png",  "f_rough_4k.png"};
  const Discovery found = session.find();
  const auto remark = [&](const std::string& name) {
    const FoundSet& set = set_at(found, name);
    CHECK(set.state == SetState::kFaulty);
    REQUIRE(set.remarks.size() == 1);
    return set.remarks.front();
  };
  CHECK(remark("a") ==
        "a: 2 roughness maps found: a_Roughness.exr (roughness), a_rough.png (roughness); keep one, or "
        "choose by --prefer WORD");
  CHECK(remark("b") ==
        "b: 2 roughness maps found: b_glossiness.png (glossiness), b_roughness.png (roughness); keep one, or "
        "choose by --prefer WORD");
  CHECK(remark("c") ==
        "c: 2 roughness maps found: c_orm.png (roughness in G), c_roughness.png (roughness); keep one, or "
        "choose by --prefer WORD");
  CHECK(remark("d") ==
        "d: 2 specular maps found: d_spec.png (specular), d_specular.exr (specular); keep one, or choose by "
        "--prefer WORD");
  CHECK(remark("f") ==
        "f: 2 roughness maps found: f_rough_2k.png (roughness), f_rough_4k.png (roughness); keep one, or "
        "choose by --prefer WORD");
  CHECK(set_at(found, "e").state == SetState::kReady);
  CHECK_FALSE(set_at(found, "a").width);
}

TEST_CASE("find sets: a set without roughness or glossiness is skipped with the reason") {
  const SetSession session{"rough_wood_diff_2k.png", "rough_wood_ao_2k.png", "steel_Specular.png"};
  const Discovery found = session.find();
  for (const std::string name : {"rough_wood", "steel"}) {
    const FoundSet& set = set_at(found, name);
    CHECK(set.state == SetState::kSkipped);
    CHECK(set.remarks == std::vector<std::string>{name + ": no roughness or glossiness map found"});
  }
  CHECK(set_at(found, "rough_wood").maps.size() == 2);
}

TEST_CASE("find sets: an ambiguous name is read like its neighbours") {
  const SetSession session{"dark_metallic_roughness.png",   "dark_metallic_base_color.png",
                           "helmet_metallic_roughness.png", "helmet_base_color.png",
                           "red_coat_roughness.png",        "red_coat_base_color.png",
                           "car_coat_roughness.png",        "car_roughness.png"};
  const Discovery found = session.find();
  CHECK(set_paths(found) == std::vector<std::string>{"car", "dark_metallic", "helmet", "red_coat"});
  const auto width = [&](const std::string& name) {
    return use_text(set_at(found, name), set_at(found, name).width);
  };
  CHECK(width("dark_metallic") == "roughness of dark_metallic_roughness.png");
  CHECK(width("helmet") == "roughness in G of helmet_metallic_roughness.png");
  CHECK(width("red_coat") == "roughness of red_coat_roughness.png");
  CHECK(width("car") == "roughness of car_roughness.png");
}

TEST_CASE("find sets: an ordinary word needs a neighbour, a resolution or capitals") {
  const SetSession session{"robot_arm.png",   "left_Arm.png",    "brick_arm.png",  "brick_diff.png",
                           "tile_arm_2k.png", "T_Crate_ARM.png", "water_color.png"};
  const Discovery found = session.find();
  CHECK(set_paths(found) == std::vector<std::string>{"T_Crate", "brick", "tile"});
  CHECK(found.unrecognised == std::vector<fs::path>{"left_Arm.png", "robot_arm.png", "water_color.png"});
  CHECK(use_text(set_at(found, "brick"), set_at(found, "brick").width) == "roughness in G of brick_arm.png");
}

TEST_CASE("find sets: a number before the word is a resolution, unless it distinguishes sets") {
  const SetSession same{"wood_1024_rough.png", "wood_2048_spec.png", "wood_normal.png"};
  CHECK(set_paths(same.find()) == std::vector<std::string>{"wood"});
  const SetSession apart{"wood_128_rough.png", "wood_256_rough.png", "wood_256_spec.png",
                         "wood_300_rough.png"};
  CHECK(set_paths(apart.find()) == std::vector<std::string>{"wood_128", "wood_256", "wood_300"});
  const SetSession series{"prop_127_rough.png", "prop_128_rough.png", "prop_128_spec.png",
                          "prop_129_rough.png"};
  CHECK(set_paths(series.find()) == std::vector<std::string>{"prop_127", "prop_128", "prop_129"});
  const SetSession two{"wood_1024_rough.png", "wood_1024_spec.png", "wood_2_rough.png"};
  CHECK(set_paths(two.find()) == std::vector<std::string>{"wood", "wood_2"});
}

TEST_CASE("find sets: spaces, Unicode, newlines and bytes that are not text") {
  const SetSession session{
      "old wood rough 2K.png", "old wood spec 2K.png", "K\xc3\xb6nig\xe2\x99\x9a_rough.png",
      "\xff\xfe_rough.png",    "a\nb_rough.png",       "a\nb_Roughness.png",
      "tab\there/x_rough.png"};
  const Discovery found = session.find();
  CHECK(set_paths(found) ==
        std::vector<std::string>{"K\xc3\xb6nig\xe2\x99\x9a", "a\nb", "old wood", "tab\there/x", "\xff\xfe"});
  CHECK(set_at(found, "old wood").specular);
  CHECK(set_at(found, "K\xc3\xb6nig\xe2\x99\x9a").state == SetState::kReady);
  CHECK(set_at(found, "a\nb").remarks.at(0) ==
        "a\\x0ab: 2 roughness maps found: a\\x0ab_Roughness.png (roughness), a\\x0ab_rough.png (roughness); "
        "keep "
        "one, or choose by --prefer WORD");
  CHECK(display_path("tab\there\x1b") == "tab\\x09here\\x1b");
  CHECK(display_path("\xc2\x9b"
                     "1m\xe2\x80\xae\xff") == "\\u009b1m\\u202e\\xff");
  CHECK(display_path(std::string(5000, 'a')).size() == 5000);
}

TEST_CASE("find sets: circular links end, and a folder is found once, by its own name") {
  const SetSession session{"a_rough.png", "z_real/b_rough.png", "z_real/deep/c_rough.png"};
  fs::create_directory_symlink(session.root(), session.root() / "z_real/deep/up");
  fs::create_directory_symlink(session.root() / "z_real", session.root() / "a_link");
  fs::create_directory_symlink("itself", session.root() / "itself");
  fs::create_symlink(session.root() / "a_rough.png", session.root() / "z_real/linked_rough.png");
  const Discovery found = session.find();
  CHECK(set_paths(found) == std::vector<std::string>{"a", "z_real/b", "z_real/deep/c", "z_real/linked"});
  CHECK(found.problems.empty());
}

TEST_CASE("find sets: a folder outside is found through its link") {
  const SetSession outside{"b_rough.png"};
  const SetSession session{"a_rough.png"};
  fs::create_directory_symlink(outside.root(), session.root() / "library");
  CHECK(set_paths(session.find()) == std::vector<std::string>{"a", "library/b"});
}

TEST_CASE("find sets: a broken link and a pipe are problems, the rest is found") {
  const SetSession session{"a_rough.png"};
  fs::create_symlink("nowhere.png", session.root() / "b_rough.png");
  REQUIRE(::mkfifo((session.root() / "c_rough.png").c_str(), 0600) == 0);
  const Discovery found = session.find();
  CHECK(set_paths(found) == std::vector<std::string>{"a"});
  REQUIRE(found.problems.size() == 2);
  CHECK(found.problems[0].path == "b_rough.png");
  CHECK(found.problems[0].message.find("b_rough.png: cannot be read: ") != std::string::npos);
  CHECK(found.problems[1].message.ends_with("c_rough.png: cannot be read: not a file"));
}

TEST_CASE("find sets: an unreadable folder is a problem, the rest is found", "[needs]") {
  const SetSession session{"a_rough.png", "locked/b_rough.png", "open/c_rough.png"};
  fs::permissions(session.root(), fs::perms(0755));
  fs::permissions(session.root() / "locked", fs::perms::none);
  {
    const OrdinaryUser user;
    if (::access(session.root().c_str(), R_OK | X_OK) != 0 || ::geteuid() == 0) {
      skip("permissions", "root reads every folder, and this process cannot be anybody else");
    } else {
      const Discovery found = session.find();
      CHECK(set_paths(found) == std::vector<std::string>{"a", "open/c"});
      REQUIRE(found.problems.size() == 1);
      CHECK(found.problems[0].path == "locked");
      CHECK(found.problems[0].message ==
            (session.root() / "locked").string() + ": cannot be read: Permission denied");
      CHECK_THROWS_AS(find_sets(session.root() / "locked", {}), Error);
    }
  }
  fs::permissions(session.root() / "locked", fs::perms::owner_all);
}

TEST_CASE("find sets: a missing root is refused") {
  const SetSession session{"a_rough.png"};
  CHECK_THROWS_AS(find_sets(session.root() / "none", {}), Error);
  CHECK_THROWS_AS(find_sets(session.root() / "a_rough.png", {}), Error);
}

TEST_CASE("find sets: maps without a stem are named for their folder") {
  const SetSession session{"hero/roughness.exr", "hero/specular.exr"};
  const Discovery found = session.find();
  CHECK(set_paths(found) == std::vector<std::string>{"hero/hero"});
  CHECK(set_paths(find_sets(session.root() / "hero/", {})) == std::vector<std::string>{"hero"});
}

TEST_CASE("find sets: real assets", "[needs]") {
  const fs::path data = shared_data("textures");
  if (data.empty()) return;
  const Discovery found = find_sets(data, {});
  const FoundSet& box = set_at(found, "BoomBox");
  CHECK(use_text(box, box.width) == "roughness in G of BoomBox_occlusionRoughnessMetallic.png");
  CHECK(set_at(found, "brass").state == SetState::kReady);
  CHECK(set_at(found, "king_black").state == SetState::kReady);
  CHECK(set_at(found, "king_shared").state == SetState::kSkipped);
  CHECK(found.unrecognised == std::vector<fs::path>{"grid_udim/grid.<UDIM>.png"});
}

TEST_CASE("find sets: five thousand files in a folder") {
  const SetSession session;
  for (int i = 0; i < 1000; ++i)
    for (const std::string map : {"_BaseColor", "_Roughness", "_Specular", "_Normal", "_Height"})
      session.add("asset_" + std::to_string(i) + map + ".png");
  const auto start = std::chrono::steady_clock::now();
  const Discovery found = session.find();
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  std::cout << "5000 files in a folder: sets found in " << taken.count() << " s\n";
  REQUIRE(found.sets.size() == 1000);
  for (const FoundSet& set : found.sets) REQUIRE((set.width && set.specular && set.maps.size() == 5));
}

namespace {

std::vector<std::string> group_names(const std::vector<std::string>& names) {
  std::vector<std::string> found;
  for (const TileGroup& group : group_tiles(names)) found.push_back(group.name);
  return found;
}

}  // namespace

TEST_CASE("tile pattern: every placeholder") {
  struct Way {
    std::string name;
    int number;
    std::string tile;
  };
  for (const auto& [name, number, tile] : std::vector<Way>{{"a.<UDIM>.exr", 1011, "a.1011.exr"},
                                                           {"a.%(UDIM)d.exr", 1011, "a.1011.exr"},
                                                           {"a_<UVTILE>.exr", 1012, "a_u2_v2.exr"},
                                                           {"a_<UVTILE>.exr", 1010, "a_u10_v1.exr"},
                                                           {"a.####.exr", 7, "a.0007.exr"},
                                                           {"a.##.exr", 123, "a.123.exr"},
                                                           {"a.%04d.exr", 12345, "a.12345.exr"},
                                                           {"a%d.exr", 0, "a0.exr"},
                                                           {"####", 1, "0001"}}) {
    INFO(name);
    const std::optional<TilePattern> pattern = tile_pattern(name);
    REQUIRE(pattern);
    CHECK(pattern->text() == name);
    CHECK(tile_name(*pattern, number) == tile);
    CHECK(tile_number(*pattern, tile) == number);
  }
}

TEST_CASE("tile pattern: names without a placeholder") {
  for (const std::string name :
       {"a.1001.exr", "a.exr", "100%.png", "a%20b.png", "a%4d.png", "a%00d.png", "<udim>", ""})
    CHECK_FALSE(tile_pattern(name));
}

TEST_CASE("tile pattern: two placeholders are refused, by name") {
  CHECK(error_of([] { tile_pattern("a.<UDIM>.####.exr"); }, ErrorKind::kUsage) ==
        "a.<UDIM>.####.exr: has two placeholders, <UDIM> and #### (use one)");
}

TEST_CASE("tile name: an invalid number is refused") {
  CHECK_THROWS_AS(tile_name(*tile_pattern("a.<UDIM>.exr"), 1000), Error);
  CHECK_THROWS_AS(tile_name(*tile_pattern("a.<UVTILE>.exr"), 2000), Error);
  CHECK_THROWS_AS(tile_name(*tile_pattern("a.####.exr"), -1), Error);
}

TEST_CASE("tile number: only the exact name of a tile counts") {
  const TilePattern udim = *tile_pattern("a.<UDIM>.exr");
  for (const std::string name :
       {"a.1000.exr", "a.2000.exr", "a.01001.exr", "a.1001.png", "b.1001.exr", "a..exr", "a.exr",
        "a.10x1.exr", "a.1001.exr.exr", "a.99999999999999999999.exr"})
    CHECK_FALSE(tile_number(udim, name));
  const TilePattern frames = *tile_pattern("a.####.exr");
  CHECK(tile_number(frames, "a.12345.exr") == 12345);
  for (const std::string name : {"a.7.exr", "a.00007.exr", "a.-001.exr"})
    CHECK_FALSE(tile_number(frames, name));
  const TilePattern uv = *tile_pattern("a_<UVTILE>.exr");
  for (const std::string name : {"a_u0_v1.exr", "a_u11_v1.exr", "a_u01_v1.exr", "a_U1_v1.exr", "a_u1v1.exr"})
    CHECK_FALSE(tile_number(uv, name));
}

TEST_CASE("tile number: u and v agree with the UDIM for all tiles") {
  const TilePattern udim = *tile_pattern("<UDIM>"), uv = *tile_pattern("<UVTILE>");
  for (int number = 1001; number <= 1999; ++number) {
    const int u = (number - 1001) % 10, v = (number - 1001) / 10;
    REQUIRE(tile_number(uv, "u" + std::to_string(u + 1) + "_v" + std::to_string(v + 1)) == number);
    REQUIRE(tile_number(udim, tile_name(udim, number)) == number);
  }
}

TEST_CASE("group tiles: a plain list becomes maps") {
  const std::vector<TileGroup> groups =
      group_tiles(std::vector<std::string>{"grid.1011.png", "grid.1001.png", "grid.1002.png", "wood.png"});
  REQUIRE(groups.size() == 2);
  CHECK(groups[0].name == "grid.<UDIM>.png");
  CHECK(groups[0].numbers == std::vector{1001, 1002, 1011});
  CHECK(groups[1].name == "wood.png");
  CHECK_FALSE(groups[1].pattern);
}

TEST_CASE("group tiles: what is a tile and what is not") {
  CHECK(group_names({"a.1001.png"}) == std::vector<std::string>{"a.<UDIM>.png"});
  CHECK(group_names({"a_1001_rough.png"}) == std::vector<std::string>{"a_<UDIM>_rough.png"});
  CHECK(group_names({"1001.png", "1002.png"}) == std::vector<std::string>{"<UDIM>.png"});
  CHECK(group_names({"a_rough_u1_v1.tif", "a_rough_u2_v1.tif"}) ==
        std::vector<std::string>{"a_rough_<UVTILE>.tif"});
  // These are not tiles: years, sizes, frames, longer numbers, and numbers within a word.
  for (const std::vector<std::string>& names :
       std::vector<std::vector<std::string>>{{"castle_1905_rough.png"},
                                             {"a_rough_1024.png"},
                                             {"a_rough_1024.png", "a_rough_2048.png"},
                                             {"a.0001.png", "a.0002.png"},
                                             {"a.11001.png", "a.11002.png"},
                                             {"a1001.png", "a1002.png"},
                                             {"a.1000.png", "a.2000.png"},
                                             {"a_U1_V1.png"}})
    CHECK(group_names(names) == names);
  // If there are other tiles, 1024 is a tile.
  CHECK(group_names({"a.1023.png", "a.1024.png"}) == std::vector<std::string>{"a.<UDIM>.png"});
  // Tiles in different formats are two maps.
  CHECK(group_names({"a.1001.exr", "a.1002.png"}).size() == 2);
}

TEST_CASE("group tiles: names with newlines and bytes beyond ASCII") {
  CHECK(group_names({"a\nb.1001.png", "a\nb.1002.png", "K\xc3\xb6nig \xff.1001.png"}) ==
        std::vector<std::string>{"K\xc3\xb6nig \xff.<UDIM>.png", "a\nb.<UDIM>.png"});
}

TEST_CASE("group tiles: every name is in one group, which reproduces it") {
  const std::vector<std::string> parts = {"a",  "_",  ".",  "-",     "1001", "1002", "1024",
                                          "u1", "v1", "u2", "rough", "\n",   "4k"};
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    std::set<std::string> names;
    while (names.size() < 40) {
      std::string name;
      for (unsigned i = 0; i < 1 + random() % 7; ++i) name += parts[random() % parts.size()];
      names.insert(name + (random() % 2 == 0 ? ".png" : ""));
    }
    std::multiset<std::string> found;
    for (const TileGroup& group : group_tiles(std::vector<std::string>(names.begin(), names.end()))) {
      if (!group.pattern) found.insert(group.name);
      for (const int number : group.numbers) {
        found.insert(tile_name(*group.pattern, number));
        REQUIRE(tile_number(*group.pattern, tile_name(*group.pattern, number)) == number);
      }
    }
    REQUIRE(found == std::multiset<std::string>(names.begin(), names.end()));
  }
}

TEST_CASE("existing tiles: the tiles of the folder, by number") {
  const TemporaryFolder folder;
  for (const std::string name : {"a.1011.exr", "a.1001.exr", "a.0999.exr", "b.1001.exr", "a.1002.exr.bak"})
    std::ofstream(folder.path() / name).put('x');
  std::filesystem::create_directory(folder.path() / "a.1003.exr");
  const Tiles expected = {{1001, folder.path() / "a.1001.exr"}, {1011, folder.path() / "a.1011.exr"}};
  CHECK(existing_tiles(folder.path() / "a.<UDIM>.exr") == expected);
  CHECK(existing_tiles(folder.path() / "a.####.exr").size() == 3);
  CHECK(existing_tiles(folder.path() / "c.<UDIM>.exr").empty());
  CHECK_THROWS_AS(existing_tiles(folder.path() / "a.exr"), Error);
  CHECK_THROWS_AS(existing_tiles(folder.path() / "<UDIM>" / "a.<UDIM>.exr"), Error);
  CHECK_THROWS_AS(existing_tiles(folder.path() / "none" / "a.<UDIM>.exr"), Error);
}
