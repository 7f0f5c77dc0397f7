// This file tests patterns of tiles and frames, and tiles that are recognised without a pattern.
#include "sets/tiles.hpp"

#include <fstream>
#include <random>
#include <set>

#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "support/temporary_folder.hpp"

using namespace remap;

namespace {

std::string tile_complaint(const std::string& name) {
  try {
    tile_pattern(name);
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::kUsage);
    return error.what();
  }
  return "none";
}

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
  CHECK(tile_complaint("a.<UDIM>.####.exr") ==
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
