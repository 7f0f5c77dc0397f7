// The texture sets of a folder or tree, found by the names of their maps.
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
#include "model/convention.hpp"

namespace remap {

// One map of a set: a file, or the tiles of a pattern.
struct FoundMap {
  std::filesystem::path path;  // relative to the root; with `<UDIM>` in the name where there are tiles
  std::optional<TilePattern> pattern;  // of the file name
  std::vector<Tile> tiles;             // by number, paths relative to the root; empty for a single file
  std::vector<int> missing_tiles;      // that other maps of the set have
  std::string habit;
  std::vector<ChannelMeaning> meaning;
};

// Where a role of a set is found.
struct MapUse {
  std::size_t map = 0;  // in FoundSet::maps, and FoundSet::bystanders after those
  Channels channels = Channels::kWhole;
  Role role = Role::kRoughness;
};

enum class SetState {
  kReady,    // there is one map for the width of the highlight, and at most one for specular
  kSkipped,  // nothing here is converted; `remarks` says why
  kFaulty,   // ambiguous; `remarks` shows the candidates
};

struct FoundSet {
  std::string name;              // the stem of the files; the folder's name where the maps have no stem
  std::filesystem::path folder;  // relative to the root; empty for the root itself
  SetState state = SetState::kReady;
  std::vector<FoundMap> maps;        // that take part, by path
  std::vector<FoundMap> bystanders;  // known maps that are not converted, by path
  std::optional<MapUse> width;       // roughness, glossiness or alpha; set where ready
  std::optional<MapUse> specular;    // where there is one
  std::vector<std::string> remarks;  // of a skipped or faulty set: one message of one line each
};

// Every place in the maps and bystanders of a set that holds a role which `wanted` accepts.
std::vector<MapUse> uses(const FoundSet& set, bool (*wanted)(Role));
const FoundMap& map_of(const FoundSet& set, const MapUse& use);
// The channels of an image as requests name them; none: all of it.
std::vector<std::string> channel_names(Channels channels);
// What a map of this role holds; none: what the model calls roughness.
std::optional<RoughnessConvention> convention_of(Role role);
// `2 maps for specular: a_spec.png (specular), a_orm.png (specular in R); expected one`.
std::string too_many_text(const FoundSet& set, const std::vector<MapUse>& found, const std::string& what);

struct DiscoveryOptions {
  bool recursive = true;
  std::vector<std::filesystem::path> excluded;  // folders that are not entered, such as the one for results
  const Naming* naming = nullptr;               // null: the built-in habits
};

struct Discovery {
  std::vector<FoundSet> sets;  // by folder and name, by bytes
  std::vector<std::filesystem::path>
      unrecognised;                   // images that no habit knows; patterns where there are tiles
  std::vector<WalkProblem> problems;  // folders and files that could not be read
};

// Finds the sets of a folder. Maps belong to one set that lie in one folder and have one stem: what is left
// of the name without the word of the map, resolution and tile. Where a name can be read in two ways
// (dark_metallic_roughness), the longer word is taken unless only the shorter one leaves a stem that another
// map has. The result does not depend on the order in which the system lists files. Throws kInput where the
// root cannot be read; all else that is wrong is part of the result.
Discovery find_sets(const std::filesystem::path& root, const DiscoveryOptions& options);

// A file that the conversion of a set would write.
struct PlannedOutput {
  std::filesystem::path path;
  std::filesystem::path source;  // what it is made from, for messages
};
using OutputPlan = std::function<std::vector<PlannedOutput>(const FoundSet&)>;

// Two outputs of one name; sets are indices.
struct OutputCollision {
  std::filesystem::path path;
  std::size_t first_set = 0;
  std::filesystem::path first_source;
  std::size_t second_set = 0;
  std::filesystem::path second_source;
};

// The outputs of ready sets that an earlier one would write too. Names are compared byte by byte, after `.`
// and `..` are resolved in the text: links and file systems that ignore case are not looked at.
std::vector<OutputCollision> output_collisions(std::span<const FoundSet> sets, const OutputPlan& plan);

}  // namespace remap
