// This file finds the texture sets of a folder or tree by the names of their maps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "remap/model.hpp"
#include "sets/folder_walk.hpp"
#include "sets/naming.hpp"
#include "sets/tiles.hpp"

namespace remap {

// A FoundMap is one map of a set: a file, or the tiles of a pattern.
struct FoundMap {
  std::filesystem::path path;          // relative to the root; `<UDIM>` in the name if the map has tiles
  std::optional<TilePattern> pattern;  // pattern of the file name
  Tiles tiles;                         // paths relative to the root; empty for a single file
  std::string habit;
  std::vector<ChannelMeaning> meaning;
  bool is_repeated = false;   // another map of the set provides one of its parameters
  bool is_converted = false;  // has roughness or specular, the only maps that a BRDF conversion reads
};
bool has_roughness_or_specular(const std::vector<ChannelMeaning>& meaning);

// A MapUse is the map and channels that hold a role.
struct MapUse {
  std::size_t map = 0;  // index into FoundSet::maps
  Channels channels = Channels::kWhole;
  Role role = Role::kRoughness;
};

enum class SetState {
  kReady,    // one roughness map and at most one specular map
  kSkipped,  // nothing to convert; `remarks` has the reason
  kFaulty,   // ambiguous; `remarks` lists the candidates
};

struct FoundSet {
  std::string name;              // the stem of the files, or the folder's name if they have no stem
  std::filesystem::path folder;  // relative to the root; empty for the root itself
  SetState state = SetState::kReady;
  std::vector<FoundMap> maps;        // converted maps first, then the others, each by path
  std::optional<MapUse> width;       // roughness, glossiness or alpha; set if ready
  std::optional<MapUse> specular;    // none if the set has no specular map
  std::vector<std::string> remarks;  // messages of one line about a skipped or faulty set
};

// Returns the maps and the channels of packed maps whose role `wanted` accepts.
std::vector<MapUse> uses(const FoundSet& set, bool (*wanted)(Role));
// Returns the channel names for a request. Returns nothing if the request is for the whole image.
std::vector<std::string> channel_names(Channels channels);
// Returns the encoding of a map of this role. Returns nothing if the map holds the model's roughness.
std::optional<RoughnessEncoding> encoding_of(Role role);
// Sets `state`, `width`, `specular` and `remarks` from the roles of the maps.
void judge(FoundSet& set);
// Returns a text like `2 specular maps found: a_spec.png (specular), a_orm.png (specular in R); keep one`.
std::string too_many_text(const FoundSet& set, const std::vector<MapUse>& found, const std::string& what);

struct Discovery {
  std::vector<FoundSet> sets;  // sorted by folder and name, byte by byte
  std::vector<std::filesystem::path>
      unrecognised;                           // images that match no naming convention; tiles as one pattern
  std::vector<std::filesystem::path> others;  // files of WalkOptions::also, sorted byte by byte
  std::vector<WalkProblem> problems;          // folders and files that could not be read
  std::map<std::filesystem::path, std::uintmax_t> sizes;  // sizes from a manifest; otherwise empty
};

// Finds the sets of a folder. The maps of a set lie in one folder and have the same stem, which is the name
// without the word of the map, resolution and tile. If a name can be read in two ways
// (dark_metallic_roughness), the longer word wins, unless only the stem of the shorter word belongs to
// another map. The result does not depend on the order in which the system lists files. Throws kInput if the
// root cannot be read. All other problems are part of the result.
Discovery find_sets(const std::filesystem::path& root, const WalkOptions& options,
                    const Naming& naming = built_in_naming());

}  // namespace remap
