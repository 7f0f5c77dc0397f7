// Finds the texture sets of a folder or tree by the names of their maps.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "discovery/folder_walk.hpp"
#include "discovery/naming.hpp"
#include "discovery/tiles.hpp"
#include "remap/convention.hpp"

namespace remap {

// One map of a set: a file, or the tiles of a pattern.
struct FoundMap {
  std::filesystem::path path;          // relative to the root; `<UDIM>` in the name stands for tiles
  std::optional<TilePattern> pattern;  // of the file name
  std::vector<Tile> tiles;             // by number, paths relative to the root; empty for a single file
  std::vector<int> missing_tiles;      // tiles that only other maps of the set have
  std::string habit;
  std::vector<ChannelMeaning> meaning;
};

// The map and channels that hold a role.
struct MapUse {
  std::size_t map = 0;  // index into FoundSet::maps, continued in FoundSet::bystanders
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
  std::vector<FoundMap> maps;        // maps to convert, by path
  std::vector<FoundMap> bystanders;  // recognised maps that are not converted, by path
  std::optional<MapUse> width;       // roughness, glossiness or alpha; set where ready
  std::optional<MapUse> specular;    // none if the set has no specular map
  std::vector<std::string> remarks;  // messages of one line about a skipped or faulty set
};

// All places in the maps and bystanders of a set with a role that `wanted` accepts.
std::vector<MapUse> uses(const FoundSet& set, bool (*wanted)(Role));
const FoundMap& map_of(const FoundSet& set, const MapUse& use);
// The channel names that a request uses; empty for the whole image.
std::vector<std::string> channel_names(Channels channels);
// The encoding of a map of this role; none for the roughness as the model defines it.
std::optional<RoughnessConvention> convention_of(Role role);
// `2 specular maps found: a_spec.png (specular), a_orm.png (specular in R); keep one`.
std::string too_many_text(const FoundSet& set, const std::vector<MapUse>& found, const std::string& what);

struct DiscoveryOptions {
  bool recursive = true;
  std::vector<std::filesystem::path> excluded;  // folders to skip, such as the one for results
  const Naming* naming = nullptr;               // null for the built-in habits
};

struct Discovery {
  std::vector<FoundSet> sets;                       // by folder and name, by bytes
  std::vector<std::filesystem::path> unrecognised;  // images that no habit matches; tiles as one pattern
  std::vector<WalkProblem> problems;                // folders and files that could not be read
};

// Finds the sets of a folder. The maps of a set lie in one folder and share a stem: the name without the word
// of the map, resolution and tile. If a name can be read in two ways (dark_metallic_roughness), the longer
// word wins, unless only the shorter one leaves the stem of another map. The result does not depend on the
// order in which the system lists files. Throws kInput if the root cannot be read; all other problems are
// part of the result.
Discovery find_sets(const std::filesystem::path& root, const DiscoveryOptions& options);

// A file that the conversion of a set will write.
struct PlannedOutput {
  std::filesystem::path path;
  std::filesystem::path source;  // a source map, for messages
};
using OutputPlan = std::function<std::vector<PlannedOutput>(const FoundSet&)>;

// Two outputs with the same name; sets are indices.
struct OutputCollision {
  std::filesystem::path path;
  std::size_t first_set = 0;
  std::filesystem::path first_source;
  std::size_t second_set = 0;
  std::filesystem::path second_source;
};

// The outputs of ready sets that an earlier set would write, too. Names are compared byte by byte after `.`
// and `..` are resolved in the text; links and case-insensitive file systems are not considered.
std::vector<OutputCollision> output_collisions(std::span<const FoundSet> sets, const OutputPlan& plan);

}  // namespace remap
