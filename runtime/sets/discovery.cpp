#include "sets/discovery.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "sets/naming.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

// A NamedMap is a map of a folder, with all ways to read its name.
struct NamedMap {
  TileGroup files;
  std::vector<NameReading> readings;
  std::size_t chosen = 0;  // index of the chosen reading
  bool numbered = false;   // the number before the map's word belongs to the set's name

  const NameReading& reading() const { return readings[chosen]; }
  const std::string& stem() const { return numbered ? reading().numbered_stem : reading().stem; }
};

// Returns the name without extension and tile, for Naming::read().
std::string readable_name(const TileGroup& files) {
  const auto without_extension = [](const std::string& name) { return name.substr(0, name.rfind('.')); };
  if (!files.pattern) return without_extension(files.name);
  const std::string after = without_extension(files.pattern->after);
  const bool doubled = !files.pattern->before.empty() && !after.empty();  // separators on both sides
  return files.pattern->before + (doubled ? after.substr(1) : after);
}

// Chooses a shorter word if the rest of the name belongs to another map, but the rest before a longer word
// does not. For example, in dark_metallic_roughness the longer word may include the end of the set's name.
// Drops doubtful readings unless another map has the same stem.
void choose_readings(std::vector<NamedMap>& maps) {
  std::map<std::string, int> map_counts;
  for (const NamedMap& map : maps) ++map_counts[map.readings.front().stem];
  for (NamedMap& map : maps) {
    if (map_counts[map.readings.front().stem] > 1) continue;
    for (std::size_t i = 1; i < map.readings.size() && map.chosen == 0; ++i)
      if (map_counts.contains(map.readings[i].stem)) map.chosen = i;
    if (map.chosen == 0)
      std::erase_if(map.readings, [](const NameReading& reading) { return reading.doubtful; });
  }
}

// Returns the name with a # for each digit at its end: prop_### for prop_127.
std::string shape_of(std::string name) {
  for (std::size_t i = name.size(); i > 0 && is_digit(name[i - 1]); --i) name[i - 1] = '#';
  return name;
}

// Keeps numbers that distinguish sets. In wood_512_rough and wood_1024_rough, the numbers are not
// resolutions, nor is the number of prop_128_rough beside prop_127_rough.
void choose_stems(std::vector<NamedMap>& maps) {
  std::set<std::string> shapes;
  for (const NamedMap& map : maps) shapes.insert(shape_of(map.stem()));
  std::map<std::pair<std::string, std::vector<ChannelMeaning>>, std::set<std::string>> numbered_stems;
  std::set<std::string> numbered;
  for (const NamedMap& map : maps) {
    std::set<std::string>& stems = numbered_stems[{map.stem(), map.reading().meaning}];
    stems.insert(map.reading().numbered_stem);
    const std::string& numbered_stem = map.reading().numbered_stem;
    const bool is_in_series = numbered_stem != map.stem() && shapes.contains(shape_of(numbered_stem));
    if (stems.size() > 1 || is_in_series) numbered.insert(map.stem());
  }
  for (NamedMap& map : maps) map.numbered = numbered.contains(map.stem());
}

FoundMap found_map(const fs::path& folder, const NamedMap& map) {
  const fs::path path = folder / map.files.name;
  const NameReading& reading = map.reading();
  FoundMap found{path,
                 map.files.pattern,
                 {},
                 reading.habit,
                 reading.meaning,
                 false,
                 has_roughness_or_specular(reading.meaning)};
  for (const int number : map.files.numbers)
    found.tiles[number] = folder / tile_name(*map.files.pattern, number);
  return found;
}

std::string place_of(const FoundSet& set) { return display_path(set.folder / set.name); }

// Returns the only map that has such a role. If several maps have it, the set is faulty.
std::optional<MapUse> single_use(FoundSet& set, bool (*wanted)(Role), const std::string& what) {
  const std::vector<MapUse> candidates = uses(set, wanted);
  if (candidates.size() == 1) return candidates.front();
  if (candidates.size() > 1) {
    set.state = SetState::kFaulty;
    set.remarks.push_back(place_of(set) + ": " + too_many_text(set, candidates, what));
  }
  return std::nullopt;
}

void add_sets(const fs::path& folder, const std::string& folder_name, const std::vector<std::string>& images,
              const Naming& naming, Discovery& discovery) {
  std::vector<NamedMap> maps;
  for (TileGroup& files : group_tiles(images)) {
    std::vector<NameReading> readings = naming.read(readable_name(files));
    if (readings.empty())
      discovery.unrecognised.push_back(folder / files.name);
    else
      maps.push_back({std::move(files), std::move(readings)});
  }
  choose_readings(maps);
  std::erase_if(maps, [&](const NamedMap& map) {
    if (map.readings.empty()) discovery.unrecognised.push_back(folder / map.files.name);
    return map.readings.empty();
  });
  choose_stems(maps);

  std::map<std::string, FoundSet> sets;
  for (const NamedMap& map : maps) {
    FoundSet& set = sets[map.stem()];
    set.name = map.stem().empty() ? folder_name : map.stem();
    set.folder = folder;
    set.maps.push_back(found_map(folder, map));
  }
  for (auto& [stem, set] : sets) {
    std::stable_partition(set.maps.begin(), set.maps.end(),
                          [](const FoundMap& map) { return map.is_converted; });
    judge(set);
    discovery.sets.push_back(std::move(set));
  }
}

// Returns the last name of a path, after `.` and `..` are resolved.
std::string last_name(const fs::path& path) {
  std::error_code failure;
  const fs::path whole = fs::weakly_canonical(path, failure);
  const fs::path& named = failure ? path : whole;
  return named.filename().empty() ? named.parent_path().filename().string() : named.filename().string();
}

}  // namespace

bool has_roughness_or_specular(const std::vector<ChannelMeaning>& meaning) {
  return std::ranges::any_of(meaning, [](const ChannelMeaning& entry) {
    return is_roughness(entry.role) || entry.role == Role::kSpecular;
  });
}

void judge(FoundSet& set) {
  set.state = SetState::kReady;
  set.remarks.clear();
  set.width = single_use(set, is_roughness, "roughness");
  set.specular = single_use(set, is<Role::kSpecular>, "specular");
  if (set.state == SetState::kFaulty || set.width) return;
  set.state = SetState::kSkipped;
  std::string squared;
  for (const MapUse& use : uses(set, is<Role::kGlossinessSquared>))
    squared = " (" + display_path(set.maps[use.map].path.filename()) +
              " contains squared glossiness, which texremap does not convert; export glossiness instead)";
  set.remarks.push_back(place_of(set) + ": no roughness or glossiness map found" + squared);
}

std::vector<MapUse> uses(const FoundSet& set, bool (*wanted)(Role)) {
  std::vector<MapUse> found;
  for (std::size_t i = 0; i < set.maps.size(); ++i)
    for (const ChannelMeaning& entry : set.maps[i].meaning)
      if (wanted(entry.role)) found.push_back({i, entry.channels, entry.role});
  return found;
}

std::vector<std::string> channel_names(Channels channels) {
  if (channels == Channels::kWhole) return {};
  if (channels == Channels::kRgb) return {"R", "G", "B"};
  return {std::string(name_of(kChannels, channels))};
}

std::optional<RoughnessEncoding> encoding_of(Role role) {
  if (role == Role::kGlossiness) return RoughnessEncoding::kGlossiness;
  if (role == Role::kAlphaWidth) return RoughnessEncoding::kAlpha;
  return std::nullopt;
}

std::string too_many_text(const FoundSet& set, const std::vector<MapUse>& found, const std::string& what) {
  std::string text;
  for (const MapUse& use : found) {
    text += (text.empty() ? "" : ", ") + display_path(set.maps[use.map].path.filename()) + " (";
    text += role_name(use.role);
    if (use.channels != Channels::kWhole) text += " in " + std::string(name_of(kChannels, use.channels));
    text += ")";
  }
  return std::to_string(found.size()) + " " + what + " maps found: " + text +
         "; keep one, or choose by --prefer WORD";
}

Discovery find_sets(const fs::path& root, const WalkOptions& options, const Naming& naming) {
  Walk walk = walk_images(root, options);
  Discovery discovery;
  discovery.problems = std::move(walk.problems);
  discovery.others = std::move(walk.others);
  for (const auto& [folder, images] : walk.images)
    add_sets(folder, folder.empty() ? last_name(root) : folder.filename().string(), images, naming,
             discovery);

  const auto key = [](const FoundSet& set) { return (set.folder / set.name).string(); };
  std::ranges::stable_sort(discovery.sets,
                           [&](const FoundSet& a, const FoundSet& b) { return key(a) < key(b); });
  const auto bytes = [](const fs::path& a, const fs::path& b) { return a.native() < b.native(); };
  std::ranges::sort(discovery.unrecognised, bytes);
  std::ranges::sort(discovery.others, bytes);
  std::ranges::sort(discovery.problems,
                    [&](const WalkProblem& a, const WalkProblem& b) { return bytes(a.path, b.path); });
  return discovery;
}

}  // namespace remap
