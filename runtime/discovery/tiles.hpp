// Maps that are several files: UDIM tiles and sequences of frames.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace remap {

// How the number of a tile is written in a name.
enum class TileStyle {
  kUdim,    // `<UDIM>` or `%(UDIM)d`: 1001 + u + 10 v, 1001 to 1999
  kUvTile,  // `<UVTILE>`: u1_v1 is the tile 1001, as in Mudbox and MaterialX; u from 1 to 10
  kFrame,   // `####`, `%04d`: a number of at least as many digits
};

// A file name with one place for a number.
struct TilePattern {
  std::string before;  // what stands left of the number
  std::string token;   // the place as it was written: `<UDIM>`, `####`
  std::string after;
  TileStyle style = TileStyle::kUdim;
  int digit_count = 0;  // of a frame, at least; shorter numbers begin with zeros

  std::string text() const { return before + token + after; }
  bool operator==(const TilePattern&) const = default;
};

// One file of a tiled map.
struct Tile {
  int number = 0;  // UDIM or frame
  std::filesystem::path path;

  bool operator==(const Tile&) const = default;
};

// The place in `name`, a file name without folder; none where it has no place. A file may be called C#.png:
// ask only for names of which no file exists. Throws kUsage where there are several places.
std::optional<TilePattern> tile_pattern(std::string_view name);

// The name of one tile. Throws kUsage for a number that the style cannot write.
std::string tile_name(const TilePattern& pattern, int number);

// The number of the tile that `name` is; none where it is no tile of this map.
std::optional<int> tile_number(const TilePattern& pattern, std::string_view name);

// The files that are there, by number; `path` is folder and pattern, tiles are in that folder. Throws kUsage
// where the file name holds no place or a folder's name does, kInput where the folder cannot be read.
std::vector<Tile> existing_tiles(const std::filesystem::path& path);

// Files of one folder that are one map.
struct TileGroup {
  std::string name;                    // the file name, or that of the pattern
  std::optional<TilePattern> pattern;  // none for a single file
  std::vector<int> numbers;            // of the tiles, rising; empty for a single file
};

// Finds the maps that are UDIM or u1_v1 tiles in the names of one folder; other names stay alone, and so do
// frames, which only a pattern tells from numbered maps. A UDIM is the last number from 1001 to 1999 between
// separators or the ends of a name. A number alone counts where it is 1001 or ends the name, so that
// castle_1905_rough.png is no tile; 1024 alone is a resolution. Groups are in the order of their names, by
// bytes.
std::vector<TileGroup> group_tiles(std::span<const std::string> names);

// For each map, the tiles that another map has and it has not, rising. Maps without tiles lack none: one
// image may serve every tile.
std::vector<std::vector<int>> missing_tiles(std::span<const std::vector<int>> tiles_of_maps);

}  // namespace remap
