#include "commands/conversion_jobs.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "error.hpp"
#include "sets/discovery.hpp"
#include "sets/shown_path.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> channel_names(Channels channels) {
  if (channels == Channels::kWhole) return {};
  if (channels == Channels::kRgb) return {"R", "G", "B"};
  return {std::string(channels_name(channels))};
}

// What a map of this role holds; none: what the model calls roughness.
std::optional<RoughnessConvention> convention_of(Role role) {
  if (role == Role::kGlossiness) return RoughnessConvention::kGlossiness;
  if (role == Role::kAlphaWidth) return RoughnessConvention::kAlpha;
  return std::nullopt;
}

// The file of `map` for a tile; a map that is one file serves every tile. None where the tile is missing.
std::optional<fs::path> file_of(const FoundMap& map, int tile) {
  if (map.tiles.empty()) return map.path;
  for (const Tile& candidate : map.tiles)
    if (candidate.number == tile) return candidate.path;
  return std::nullopt;
}

std::vector<int> tiles_of(const FoundSet& set) {
  std::set<int> numbers;
  for (const FoundMap& map : set.maps)
    for (const Tile& tile : map.tiles) numbers.insert(tile.number);
  if (numbers.empty()) return {0};
  return {numbers.begin(), numbers.end()};
}

// The folder of sets turned into jobs.
class TreeJobs {
 public:
  TreeJobs(const ConvertOptions& options, const TextureSetRequest& stand_ins)
      : options_(options), stand_ins_(stand_ins), root_(options.folder) {}

  JobList list();

 private:
  void add(const FoundSet& set);
  void add_tile(const FoundSet& set, int tile);
  void carry(const FoundSet& set, int tile, TextureSetRequest& request) const;
  void require_no_collisions(const Discovery& found) const;
  std::string place(const FoundSet& set) const { return shown(root_ / set.folder / set.name); }

  const ConvertOptions& options_;
  const TextureSetRequest& stand_ins_;  // for what sets do not have, and factors for all
  fs::path root_;
  JobList jobs_;
};

JobList TreeJobs::list() {
  const Naming naming = options_.names.empty() ? built_in_naming() : read_naming(options_.names);
  DiscoveryOptions discovery;
  discovery.recursive = options_.recursive;
  discovery.naming = &naming;
  if (!options_.output.empty()) discovery.excluded = {options_.output};
  const Discovery found = find_sets(root_, discovery);
  jobs_.is_tree = true;
  jobs_.unrecognised_count = found.unrecognised.size();
  for (const WalkProblem& problem : found.problems) jobs_.left_out.push_back({problem.message, true});
  for (const FoundSet& set : found.sets) {
    if (set.state == SetState::kReady)
      add(set);
    else
      for (const std::string& remark : set.remarks)
        jobs_.left_out.push_back({remark, set.state == SetState::kFaulty});
  }
  require_no_collisions(found);
  if (jobs_.jobs.empty() && jobs_.left_out.empty())
    throw Error(ErrorKind::kUsage, root_.string() +
                                       ": has no texture set that is known by its names; expected " +
                                       (options_.recursive ? "" : "--recursive for folders below it, or ") +
                                       "--names FILE for other names");
  return std::move(jobs_);
}

void TreeJobs::add(const FoundSet& set) {
  if (!set.specular && options_.specular.empty()) {
    jobs_.left_out.push_back(
        {place(set) + ": has no specular map; expected one, or --specular VALUE for such sets", true});
    return;
  }
  for (const int tile : tiles_of(set)) add_tile(set, tile);
}

void TreeJobs::add_tile(const FoundSet& set, int tile) {
  const std::string number = tile == 0 ? "" : std::to_string(tile);
  ConversionJob job{place(set),
                    number,
                    stand_ins_,
                    fs::path(options_.output) / set.folder,
                    {set.name + "_", tile == 0 ? "" : "." + number}};
  const auto source = [&](const MapUse& use) -> std::optional<MapName> {
    const std::optional<fs::path> file = file_of(set.maps[use.map], tile);
    if (!file) {
      jobs_.left_out.push_back({job.name + (number.empty() ? "" : ", tile " + number) + ": has no " +
                                    std::string(role_name(use.role)) + " map; expected a tile " +
                                    shown(set.maps[use.map].path.filename()),
                                true});
      return std::nullopt;
    }
    return MapName{root_ / *file, channel_names(use.channels)};
  };
  const std::optional<MapName> width = source(*set.width);
  if (!width) return;
  job.request.roughness.source = *width;
  if (!job.request.convention) job.request.convention = convention_of(set.width->role);
  if (set.specular) {
    const std::optional<MapName> specular = source(*set.specular);
    if (!specular) return;
    job.request.specular.source = *specular;
  }
  if (options_.layout != layout_name(Layout::kAsInputs)) carry(set, tile, job.request);
  jobs_.jobs.push_back(std::move(job));
}

// What a layout has a place for, from the maps that are not converted.
void TreeJobs::carry(const FoundSet& set, int tile, TextureSetRequest& request) const {
  for (const std::vector<FoundMap>* maps : {&set.maps, &set.bystanders})
    for (const FoundMap& map : *maps)
      for (const ChannelMeaning& entry : map.meaning) {
        if (entry.role != Role::kOcclusion && entry.role != Role::kMetallic) continue;
        const std::string name(role_name(entry.role));
        const std::optional<fs::path> file = file_of(map, tile);
        const bool is_named =
            std::any_of(request.carried.begin(), request.carried.end(),
                        [&](const CarriedRequest& carried) { return carried.name == name; });
        if (file && !is_named)
          request.carried.push_back(
              {name, {MapName{root_ / *file, channel_names(entry.channels)}, {}, Transfer::kLinear}});
      }
}

void TreeJobs::require_no_collisions(const Discovery& found) const {
  const auto outputs = [&](const FoundSet& set) {
    std::vector<PlannedOutput> planned;
    std::set<std::size_t> used = {set.width->map};
    if (set.specular) used.insert(set.specular->map);
    for (const std::size_t map : used) {
      fs::path path = set.maps[map].path;
      if (!options_.format.empty()) path.replace_extension(options_.format);
      planned.push_back({path, set.maps[map].path});
    }
    return planned;
  };
  const std::vector<OutputCollision> collisions = output_collisions(found.sets, outputs);
  if (collisions.empty()) return;
  const OutputCollision& first = collisions.front();
  throw Error(ErrorKind::kUsage, shown(fs::path(options_.output) / first.path) +
                                     ": would be made from both " + shown(root_ / first.first_source) +
                                     " and " + shown(root_ / first.second_source) +
                                     "; expected names of their own");
}

// The parameters of a request, in one order.
template <typename Request>
auto parameters_of(Request& request) {
  std::vector<decltype(&request.roughness)> parameters = {&request.roughness, &request.specular};
  for (auto& carried : request.carried) parameters.push_back(&carried.parameter);
  return parameters;
}

// A parameter whose file name stands for tiles.
struct TiledParameter {
  std::size_t index = 0;  // among the parameters of the request
  fs::path file;
  TilePattern pattern;
};

std::vector<TiledParameter> tiled_parameters(const TextureSetRequest& request) {
  std::vector<TiledParameter> tiled;
  const auto parameters = parameters_of(request);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto* map = std::get_if<MapName>(&parameters[i]->source);
    std::error_code ignored;
    if (map == nullptr || fs::exists(map->file, ignored)) continue;
    if (const auto pattern = tile_pattern(map->file.filename().string()))
      tiled.push_back({i, map->file, *pattern});
  }
  return tiled;
}

// The tiles that any of the maps has; one that another map lacks is left out, with a message.
JobList tile_jobs(const ConvertOptions& options, const TextureSetRequest& request,
                  const std::vector<TiledParameter>& tiled) {
  JobList list;
  list.is_tree = true;
  std::map<int, std::vector<std::optional<fs::path>>> tiles;  // a file for each of `tiled`, by number
  for (std::size_t i = 0; i < tiled.size(); ++i) {
    const std::vector<Tile> own = existing_tiles(tiled[i].file);
    if (own.empty())
      throw Error(ErrorKind::kInput, tiled[i].file.string() + ": has no tile; expected at least one file");
    for (const Tile& tile : own) {
      tiles[tile.number].resize(tiled.size());
      tiles[tile.number][i] = tiled[i].file.parent_path() / tile_name(tiled[i].pattern, tile.number);
    }
  }
  for (const auto& [number, files] : tiles) {
    const std::string text = std::to_string(number);
    ConversionJob job{shown(tiled.front().file), text, request, options.output, {"", "." + text}};
    const auto parameters = parameters_of(job.request);
    bool whole = true;
    for (std::size_t i = 0; i < tiled.size(); ++i) {
      if (files[i]) {
        std::get<MapName>(parameters[tiled[i].index]->source).file = *files[i];
        continue;
      }
      const fs::path file = tiled[i].file.parent_path() / tile_name(tiled[i].pattern, number);
      list.left_out.push_back({file.string() + ": is missing; expected every tile of the set", true});
      whole = false;
    }
    if (whole) list.jobs.push_back(std::move(job));
  }
  return list;
}

}  // namespace

JobList conversion_jobs(const ConvertOptions& options, const TextureSetRequest& request) {
  if (!options.folder.empty()) return TreeJobs(options, request).list();
  if (const std::vector<TiledParameter> tiled = tiled_parameters(request); !tiled.empty())
    return tile_jobs(options, request, tiled);
  JobList list;
  list.jobs.push_back({"", "", request, options.output, {}});
  return list;
}

}  // namespace remap
