// This file handles maps of several files: UDIM tiles and sequences of frames.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace remap {

// A TileStyle is the way in which a file name holds the number of a tile.
enum class TileStyle {
  kUdim,    // `<UDIM>` or `%(UDIM)d`: 1001 + u + 10 v, 1001 to 1999
  kUvTile,  // `<UVTILE>`: u1_v1 is the tile 1001, as in Mudbox and MaterialX; u from 1 to 10
  kFrame,   // `####`, `%04d`: a number of at least this many digits
};

// A TilePattern is a file name with one placeholder for a number.
struct TilePattern {
  std::string before;  // the text before the number
  std::string token;   // the placeholder as the user wrote it: `<UDIM>`, `####`
  std::string after;
  TileStyle style = TileStyle::kUdim;
  int digit_count = 0;  // least number of digits of a frame, padded with zeros

  std::string text() const { return before + token + after; }
  bool operator==(const TilePattern&) const = default;
};

using Tiles = std::map<int, std::filesystem::path>;  // files of a tiled map by their UDIM or frame

// Returns the pattern of `name`, a file name without folder, or nothing if it has no placeholder. A real file
// may be called C#.png, so call this only if no such file exists. Throws kUsage for several placeholders.
std::optional<TilePattern> tile_pattern(std::string_view name);

// Returns the file name of one tile. Throws kUsage for a number outside the range of the style.
std::string tile_name(const TilePattern& pattern, int number);

// Returns the number of the tile with this file name, or nothing if it is not a tile of this map.
std::optional<int> tile_number(const TilePattern& pattern, std::string_view name);

// Returns the existing tiles of `path`, a folder and a pattern, by number. Throws kUsage if the file name has
// no placeholder or a folder name has one, and kInput if the folder cannot be read.
Tiles existing_tiles(const std::filesystem::path& path);

// A TileGroup is the files of one folder that form one map.
struct TileGroup {
  std::string name;                    // the file name, or the text of the pattern
  std::optional<TilePattern> pattern;  // none for a single file
  std::vector<int> numbers;            // numbers of the tiles, ascending; empty for a single file
};

// Groups the UDIM and u1_v1 tiles among the file names of one folder. Every other name is a group of one
// file. Frames are not grouped, because nothing distinguishes them from numbered maps. A UDIM is the last
// number from 1001 to 1999 between separators, or at one end of the name. If only one file has such a number,
// it is a tile only if the number is 1001 or ends the name. So castle_1905_rough.png is not a tile. If 1024
// is the only number, it is a resolution. Groups are sorted by name, byte by byte.
std::vector<TileGroup> group_tiles(std::span<const std::string> names);

}  // namespace remap
