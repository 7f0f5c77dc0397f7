#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/number_text.hpp"
#include "sets/discovery.hpp"
#include "sets/folder_walk.hpp"
#include "sets/naming.hpp"
#include "texremap/plan/asset_formats.hpp"
#include "texremap/plan/conversion_request.hpp"
#include "texremap/plan/job.hpp"
#include "texremap/plan/workflow_choice.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

// Returns the file of `map` for a tile, or nothing if it is missing. A map without tiles serves every tile.
std::optional<fs::path> file_of(const FoundMap& map, int tile) {
  if (map.tiles.empty()) return map.path;
  const auto found = map.tiles.find(tile);
  return found == map.tiles.end() ? std::nullopt : std::optional(found->second);
}

std::vector<fs::path> files_of(const FoundMap& map) {
  std::vector<fs::path> files;
  for (const auto& [number, file] : map.tiles) files.push_back(file);
  if (files.empty()) files.push_back(map.path);
  return files;
}

std::vector<int> tiles_of(const FoundSet& set) {
  std::set<int> numbers;
  const auto add = [&](bool all) {
    for (const FoundMap& map : set.maps)
      if (map.is_converted || all)
        for (const auto& [number, file] : map.tiles) numbers.insert(number);
  };
  add(false);
  if (numbers.empty()) add(true);
  if (numbers.empty()) return {0};
  return {numbers.begin(), numbers.end()};
}

// Returns the files of a set, always in the same order.
std::vector<fs::path*> files_of(SetWork& set) {
  std::vector<fs::path*> files;
  const auto add = [&](ParameterRequest& parameter) {
    if (auto* map = std::get_if<MapName>(&parameter.source)) files.push_back(&map->file);
  };
  for (auto& [parameter, asked] : set.request.parameters) add(asked);
  for (Carried<ParameterRequest>& carried : set.request.carried) add(carried.parameter);
  for (CopiedFile& copy : set.copies) files.push_back(&copy.source);
  return files;
}

// Returns true if a request has a map or numbers.
bool is_given(const ParameterRequest& request) {
  const auto* map = std::get_if<MapName>(&request.source);
  return map == nullptr || !map->file.empty();
}

// Returns the set with its diffuse map first, for a warp that converts only diffuse.
FoundSet of_diffuse_alone(FoundSet set) {
  const std::vector<MapUse> found = uses_of(set, Parameter::kDiffuse);
  if (found.empty() || set.maps[found.front().map].is_converted) return set;
  const auto map = set.maps.begin() + static_cast<std::ptrdiff_t>(found.front().map);
  map->is_converted = true;
  std::rotate(set.maps.begin(), map, map + 1);
  set.state = SetState::kReady;
  set.remarks.clear();
  return set;
}

// Turns a folder of sets into jobs.
class SetJobs {
 public:
  SetJobs(const ConvertOptions& options, const ConversionChoice& workflow, const TextureSetRequest& defaults,
          Discovery found)
      : options_(options),
        workflow_(workflow),
        choice_(target_choice(options, workflow)),
        defaults_(defaults),
        root_(options.folder),
        found_(std::move(found)) {}

  JobList list();

 private:
  void add(FoundSet set);
  void add_tile(const FoundSet& set, int tile, const std::vector<std::string>& notes);
  bool find_source(const FoundSet& set, Parameter parameter, const std::string& number, int tile,
                   SetWork& work);
  void carry(const FoundSet& set, int tile, TextureSetRequest& request) const;
  void place_others(const FoundSet& set, int tile, SetWork& work);
  bool comes_along(const FoundMap& map) const;
  bool is_rest_of_packed(const FoundMap& map, const ChannelMeaning& entry) const;
  void note_normals();
  std::set<fs::path> outputs(const FoundSet& set) const;
  bool takes_names(const FoundSet& set);
  void note_sizes(Job& job) const;
  void require_encoding_used() const;
  // Returns the map that an option gives for a parameter: one map for all sets, or a pattern. Returns null if
  // there is none.
  const MapName* given_map(Parameter parameter) const {
    const MapSource* source = options_.map_of(parameter);
    return source != nullptr ? std::get_if<MapName>(source) : nullptr;
  }
  fs::path file_of_set(const fs::path& given, const FoundSet& set, const std::string& number) const;
  void leave_out_shared();
  void leave_out_read();
  // Returns the roughness encoding of the source model, if known.
  std::optional<RoughnessEncoding> own_width() const {
    if (workflow_.is_material()) return width_of(*workflow_.source);
    return std::nullopt;
  }
  // Returns true if a set gets its missing roughness map from an option, and has other maps of the material.
  bool has_given_width(const FoundSet& set) const;
  void fail(const std::string& message) { jobs_.skipped.push_back({message, true}); }
  std::string context(const FoundSet& set) const { return display_path(root_ / set.folder / set.name); }
  std::string owner(const FoundSet& set) const {
    return "the set of " + display_path(root_ / set.maps.front().path);
  }

  const ConvertOptions& options_;
  const ConversionChoice& workflow_;
  TargetChoice choice_;
  const TextureSetRequest& defaults_;  // values for missing maps, and factors for all sets
  fs::path root_;
  Discovery found_;
  std::vector<FoundSet> converted_;
  bool is_in_place_ = same_file(options_.output, root_);    // results lie beside the maps
  std::map<std::string, std::vector<CopiedFile>> normals_;  // keyed by why green is inverted or kept
  JobList jobs_;
};

JobList SetJobs::list() {
  jobs_.is_of_folder = jobs_.has_several = true;
  if (is_in_place_ && !choice_.layout.keeps_names)
    jobs_.notes.push_back("results are written beside the maps of " + display_path(root_) +
                          ", and a later run will read both (choose another folder for --output)");
  leave_out_shared();
  for (const fs::path& image : found_.unrecognised) jobs_.unrecognised.push_back(root_ / image);
  jobs_.asset_count = found_.others.size();
  for (const WalkProblem& problem : found_.problems) fail(problem.message);
  for (const FoundSet& set : found_.sets)
    for (const FoundMap& map : set.maps)
      for (const fs::path& file : files_of(map)) (void)jobs_.names->take(root_ / file, owner(set));
  for (FoundSet& set : found_.sets) add(std::move(set));
  note_normals();
  leave_out_read();
  if (!found_.sizes.empty())
    for (Job& job : jobs_.jobs) note_sizes(job);
  if (options_.part) return std::move(jobs_);  // a part does not see all sets
  require_encoding_used();
  if (jobs_.jobs.empty() && jobs_.skipped.empty())
    throw usage_error(root_.string() + ": no texture set found by file names (use " +
                      (options_.recursive ? "" : "--recursive for subfolders, or ") +
                      "--names FILE for other names)");
  return std::move(jobs_);
}

// Returns the file of a set that a pattern means: `*` is the name of the set, `<UDIM>` the number of the
// tile.
fs::path named_after(const fs::path& pattern, const FoundSet& set, const std::string& number) {
  std::string name = pattern.string();
  const auto put = [&name](std::string_view token, const std::string& text) {
    if (const std::size_t at = name.find(token); at != std::string::npos)
      name.replace(at, token.size(), text);
  };
  put("*", set.name);
  put("<UDIM>", number);
  return name;
}

// Returns the name of a map as a pattern for all sets: `*_rough.jpg` for set sand.
std::string pattern_of(std::string name, const std::string& set) {
  if (const std::size_t at = name.find(set); at != std::string::npos && !set.empty())
    name.replace(at, set.size(), "*");
  return name;
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

// Returns the file that an option gives for a set: a file for all sets, or a file in the folder of the set.
fs::path SetJobs::file_of_set(const fs::path& given, const FoundSet& set, const std::string& number) const {
  return shared_map(options_, given).value_or(root_ / set.folder / named_after(given, set, number));
}

// Removes maps that an option gives for all sets from the found sets, because they are not sets.
void SetJobs::leave_out_shared() {
  const std::vector<fs::path> shared = shared_maps(options_);
  if (shared.empty()) return;
  const auto is_shared = [&](const fs::path& file) {
    return std::ranges::any_of(shared, [&](const fs::path& map) { return same_file(map, root_ / file); });
  };
  for (const fs::path& map : shared) jobs_.notes.push_back(display_path(map) + " is used for all sets");
  std::erase_if(found_.sets, [&](const FoundSet& set) {
    return std::ranges::all_of(set.maps, [&](const FoundMap& map) { return is_shared(map.path); });
  });
  std::erase_if(found_.unrecognised, is_shared);
}

// Removes files that a pattern of an option gives from the images whose names are not recognised.
void SetJobs::leave_out_read() {
  std::set<fs::path> read;
  for (Job& job : jobs_.jobs)
    for (const fs::path* file : files_of(std::get<SetWork>(job.work))) read.insert(*file);
  std::erase_if(jobs_.unrecognised, [&](const fs::path& file) { return read.contains(file); });
}

bool SetJobs::has_given_width(const FoundSet& set) const {
  if (given_map(Parameter::kRoughness) == nullptr &&
      !is_given(defaults_.parameters.at(Parameter::kRoughness)))
    return false;
  return std::ranges::any_of(workflow_.sources(), [&](Parameter parameter) {
    return given_map(parameter) != nullptr || !uses_of(set, parameter).empty();
  });
}

void SetJobs::add(FoundSet set) {
  std::vector<std::string> notes = choose_maps(set, workflow_.sources(), options_.prefer, own_width());
  const bool is_metallic =
      !uses(set, is<Role::kMetallic>).empty() && !uses(set, is<Role::kBaseColor>).empty();
  if (is_metallic && !workflow_.is_material())
    notes.push_back(
        context(set) + ": has base color and metallic, which " + workflow_.source_brdf +
        " does not read, so metals get a wrong specular (--from metallic converts the whole material)");
  if (set.state == SetState::kSkipped && workflow_.constants.contains(Parameter::kRoughness))
    set = of_diffuse_alone(std::move(set));
  if (set.state == SetState::kSkipped && has_given_width(set)) set.state = SetState::kReady;
  if (set.state != SetState::kReady) {
    const bool is_faulty = set.state == SetState::kFaulty;
    for (const std::string& remark : set.remarks)
      jobs_.skipped.push_back({display_path(root_) + "/" + remark +
                                   (is_faulty ? "" : " (for sets without this map, use --roughness VALUE)"),
                               is_faulty});
    return;
  }
  for (const Parameter parameter : workflow_.sources()) {
    const std::vector<MapUse> found = uses_of(set, parameter);
    const std::string name = plain_name(parameter);
    if (!found.empty() && workflow_.constants.contains(parameter))
      return fail(context(set) + ": has a " + std::string(role_name(found.front().role)) +
                  " map, but the warp converts only a diffuse map (use a warp that was made for all maps, or "
                  "give --diffuse MAP instead of the folder)");
    if (found.size() > 1) return fail(context(set) + ": " + too_many_text(set, found, name));
    if (found.empty() && given_map(parameter) == nullptr && !is_given(defaults_.parameters.at(parameter)))
      return fail(context(set) + ": no " + name + " map found (for sets without this map, use " +
                  parameter_option(parameter) + " VALUE)");
  }
  if (!takes_names(set)) return;
  converted_.push_back(set);
  for (const int tile : tiles_of(set)) add_tile(set, tile, notes);
}

// Puts the map of a parameter into the request. Adds a message and returns false if the set lacks the tile.
bool SetJobs::find_source(const FoundSet& set, Parameter parameter, const std::string& number, int tile,
                          SetWork& work) {
  const bool is_glossiness = parameter == Parameter::kRoughness && options_.reads_glossiness();
  const std::string option = is_glossiness ? "--glossiness" : parameter_option(parameter);
  ParameterRequest& asked = work.request.parameters[parameter];
  if (const MapName* given = given_map(parameter)) {
    const fs::path file = file_of_set(given->file, set, number);
    if (!is_file(file)) {
      fail(context(set) + ": " + display_path(file.filename()) + " of " + option +
           " was not found (add it, or remove the option)");
      return false;
    }
    asked.source = MapName{file, given->channels};
    asked.one_channel = one_channel(option, given->file);
    return true;
  }
  const std::vector<MapUse> found = uses_of(set, parameter);
  if (found.empty()) return true;
  const MapUse& use = found.front();
  const FoundMap& map = set.maps[use.map];
  const std::optional<fs::path> file = file_of(map, tile);
  if (!file) {
    fail(context(set) + (number.empty() ? "" : ", tile " + number) + ": no " +
         std::string(role_name(use.role)) + " map found (" + display_path(map.path.filename()) +
         " lacks this tile)");
    return false;
  }
  asked.source = MapName{root_ / *file, channel_names(use.channels)};
  asked.one_channel = one_channel(use.role == Role::kGlossiness ? "--glossiness" : option,
                                  pattern_of(map.path.filename().string(), set.name));
  // --roughness-encoding concerns maps that are found as roughness.
  if (parameter == Parameter::kRoughness && encoding_of(use.role))
    work.request.convention = encoding_of(use.role);
  return true;
}

void SetJobs::add_tile(const FoundSet& set, int tile, const std::vector<std::string>& notes) {
  const std::string number = tile == 0 ? "" : std::to_string(tile);
  SetWork work{defaults_,
               options_.output / set.folder,
               options_.diagnose / set.folder,
               {set.name, tile == 0 ? "" : "." + number},
               {},
               {},
               notes};
  for (const auto& [parameter, asked] : defaults_.parameters)
    if (!find_source(set, parameter, number, tile, work)) return;
  work.effect = effect_of(workflow_, work.request);
  if (const auto found = uses_of(set, Parameter::kDiffuse); !workflow_.is_material() && !found.empty())
    if (const auto file = file_of(set.maps[found.front().map], tile))
      work.diffuse = {root_ / *file, channel_names(found.front().channels)};
  if (!choice_.layout.keeps_names) carry(set, tile, work.request);
  place_others(set, tile, work);
  Job job{(root_ / set.folder / set.name).string(), number, owner(set)};
  job.work = std::move(work);
  jobs_.jobs.push_back(std::move(job));
}

// Returns true for a channel of a converted packed map that holds a property without a place in results (in
// ORDp: height).
bool SetJobs::is_rest_of_packed(const FoundMap& map, const ChannelMeaning& entry) const {
  constexpr std::array kRest = {Role::kCavity,       Role::kHeight,     Role::kOpacity, Role::kEmissive,
                                Role::kTransmission, Role::kSubsurface, Role::kIor};
  const bool has_color = std::ranges::any_of(
      map.meaning, [](const ChannelMeaning& other) { return other.channels == Channels::kRgb; });
  return map.is_converted && !options_.only_converted && !has_color && entry.channels != Channels::kWhole &&
         contains(kRest, entry.role);
}

// Adds the maps that are not converted but have a place in the layout.
void SetJobs::carry(const FoundSet& set, int tile, TextureSetRequest& request) const {
  const std::string number = tile == 0 ? "" : std::to_string(tile);
  const auto add_given = [&](Parameter parameter) {
    const MapSource* source = options_.map_of(parameter);
    const auto* given = source != nullptr ? std::get_if<MapName>(source) : nullptr;
    if (given == nullptr) return;
    const MapName map{file_of_set(given->file, set, number), given->channels};
    request.carried.push_back({plain_name(parameter), {map, {}, Transfer::kLinear}});
  };
  add_given(Parameter::kOcclusion);
  if (!workflow_.is_material()) add_given(Parameter::kMetallic);
  for (const FoundMap& map : set.maps)
    for (const ChannelMeaning& entry : map.meaning) {
      const bool carries_metallic = entry.role == Role::kMetallic && !workflow_.is_material();
      if (entry.role != Role::kOcclusion && !carries_metallic && !is_rest_of_packed(map, entry)) continue;
      const std::string name(role_name(entry.role));
      const std::optional<fs::path> file = file_of(map, tile);
      const bool is_named = std::ranges::any_of(
          request.carried, [&](const Carried<ParameterRequest>& carried) { return carried.name == name; });
      if (file && !is_named)
        request.carried.push_back(
            {name, {MapName{root_ / *file, channel_names(entry.channels)}, {}, Transfer::kLinear}});
    }
}

bool is_normal(const FoundMap& map) {
  const std::string name = lower(map.path.filename().string());
  return contains(map.meaning, Role::kNormal, &ChannelMeaning::role) ||
         name.find("normal") != std::string::npos;  // normal map of a coat
}

// Adds one note for all normal maps with the same reason.
void SetJobs::note_normals() {
  for (const auto& [reason, maps] : normals_) {
    const CopiedFile& first = maps.front();
    const std::string done =
        first.turned_name.empty() ? "kept" : "inverted in the copy " + display_path(first.turned_name);
    const std::string more =
        maps.size() == 1 ? "" : " (the same for " + counted(maps.size() - 1, "more normal map") + ")";
    jobs_.notes.push_back(display_path(first.source) + ": green is " + done + ", because " + reason + more);
  }
}

// Copies or reports files that the conversion does not read. A map without tiles is copied with the first
// tile.
void SetJobs::place_others(const FoundSet& set, int tile, SetWork& work) {
  const std::vector<fs::path*> read = files_of(work);
  const bool is_first = tile == tiles_of(set).front();
  for (const FoundMap& map : set.maps) {
    const std::optional<fs::path> file = file_of(map, tile);
    if (!file || (map.tiles.empty() && !is_first)) continue;
    const fs::path source = root_ / *file;
    if (contains(map.meaning, Role::kNormal, &ChannelMeaning::role) && work.normals.empty()) {
      work.normals = source;
      work.green = stated_green(source.filename().string())
                       .value_or(normals_of(options_.from).value_or(NormalGreen::kUp));
    }
    if (std::ranges::any_of(read, [&](const fs::path* known) { return *known == source; })) continue;
    if (!comes_along(map)) {
      work.left_behind.push_back(source);
      continue;
    }
    if (is_in_place_) continue;
    if (!is_normal(map)) {
      work.copies.push_back({source, "", ""});
      continue;
    }
    CopiedFile normals = copied_normals(options_, source);
    if (!normals.reason.empty()) normals_[normals.reason].push_back(normals);
    work.copies.push_back(std::move(normals));
  }
}

// Returns true if a map that the conversion does not read is copied. If a parameter has two maps, the unused
// one is not copied, because it would be a second, unconverted form.
bool SetJobs::comes_along(const FoundMap& map) const {
  constexpr std::array kConverted = {Role::kRoughness,  Role::kGlossiness, Role::kGlossinessSquared,
                                     Role::kAlphaWidth, Role::kSpecular,   Role::kSpecularLevel,
                                     Role::kDiffuse,    Role::kBaseColor,  Role::kMetallic};
  if (options_.only_converted || map.is_repeated) return false;
  const bool is_of_source = std::ranges::any_of(map.meaning, [&](const ChannelMeaning& entry) {
    return entry.input && workflow_.has_source(*entry.input);
  });
  if (workflow_.translation && is_of_source) return false;  // an option gives another map
  return !workflow_.is_material() || std::ranges::none_of(map.meaning, [&](const ChannelMeaning& entry) {
    return contains(kConverted, entry.role);
  });
}

// Returns the files that the conversion of a set writes. All tiles of a map are one entry.
std::set<fs::path> SetJobs::outputs(const FoundSet& set) const {
  const FoundMap& first = set.width ? set.maps[set.width->map] : set.maps.front();
  const std::string end =
      (tiles_of(set).front() == 0 ? "" : ".<UDIM>") +
      (choice_.extension.empty() ? first.path.extension().string() : "." + choice_.extension);
  const ResultNames names{set.name, end};
  std::set<fs::path> files;
  TargetChoice choice = choice_;
  if (workflow_.translation) {
    TextureSetRequest request = defaults_;
    for (auto& [parameter, asked] : request.parameters)
      if (given_map(parameter) != nullptr || !uses_of(set, parameter).empty()) asked.source = MapName{};
    apply(*effect_of(workflow_, request), choice);
  }
  for (const Parameter parameter : choice.parameters) {
    const std::vector<MapUse> found = uses_of(set, parameter);
    fs::path path = set.folder / file_name(parameter, choice_, names);
    if (choice_.layout.keeps_names && !found.empty()) {
      path = set.maps[found.front().map].path;
      if (!choice_.extension.empty()) path.replace_extension(choice_.extension);
    }
    files.insert(options_.output / path);
  }
  for (const TargetChannel& diagnosis : choice_.diagnoses)
    files.insert(options_.diagnose / set.folder / diagnosis_name(diagnosis, names));
  return files;
}

void SetJobs::note_sizes(Job& job) const {
  for (const fs::path* file : files_of(std::get<SetWork>(job.work)))
    if (const auto found = found_.sizes.find(file->lexically_relative(root_)); found != found_.sizes.end())
      job.listed[*file] = found->second;
}

// Refuses --roughness-encoding if no map is found as roughness.
void SetJobs::require_encoding_used() const {
  if (!options_.roughness_encoding || converted_.empty()) return;
  const auto speaks_of = [](const FoundSet& set) { return !set.width || !encoding_of(set.width->role); };
  if (std::ranges::none_of(converted_, speaks_of))
    throw usage_error(
        "--roughness-encoding: has no effect, because the file names of all maps give the encoding (remove "
        "this option)");
}

// Reserves the names of a set's results, and of copies of its maps. If another set has one of these names,
// adds a message and returns false.
bool SetJobs::takes_names(const FoundSet& set) {
  const auto take = [&](const fs::path& path) {
    const std::string other = jobs_.names->take(path, owner(set));
    if (!other.empty()) fail(written_twice_text(path, other, owner(set)));
    return other.empty();
  };
  if (!std::ranges::all_of(outputs(set), take)) return false;
  for (const FoundMap& map : set.maps)
    if (comes_along(map))
      for (const fs::path& file : files_of(map))
        if (!take(options_.output / file)) return false;
  return true;
}

// A TiledFile is a file name with a placeholder for the tile.
struct TiledFile {
  std::size_t index = 0;  // index among the files of the job
  fs::path file;
  TilePattern pattern;

  fs::path tile(int number) const { return file.parent_path() / tile_name(pattern, number); }
  // Returns the number as file names write it: 0012 for a frame.
  std::string number_text(int number) const {
    const std::string name = tile_name(pattern, number);
    return name.substr(pattern.before.size(), name.size() - pattern.before.size() - pattern.after.size());
  }
};

std::vector<TiledFile> tiled_files(SetWork& set) {
  std::vector<TiledFile> tiled;
  const std::vector<fs::path*> files = files_of(set);
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::error_code ignored;
    if (fs::exists(*files[i], ignored)) continue;
    if (const auto pattern = tile_pattern(files[i]->filename().string()))
      tiled.push_back({i, *files[i], *pattern});
  }
  return tiled;
}

// Makes one job for each tile that all maps have. It skips a tile that some map lacks, with a message.
JobList tile_jobs(const SetWork& whole_set, const std::vector<TiledFile>& tiled) {
  JobList list;
  list.has_several = true;
  if (tiled.front().pattern.style == TileStyle::kFrame) list.tile_noun = "frame";
  std::map<int, std::set<std::size_t>> tiles;  // indices into `tiled` of the maps with that tile
  for (std::size_t i = 0; i < tiled.size(); ++i) {
    const Tiles own = existing_tiles(tiled[i].file);
    if (own.empty()) throw input_error(tiled[i].file.string() + ": no " + list.tile_noun + " found");
    for (const auto& [number, file] : own) tiles[number].insert(i);
  }
  for (const auto& [number, present] : tiles) {
    SetWork set = whole_set;
    set.names.after = "." + tiled.front().number_text(number);
    const std::vector<fs::path*> files = files_of(set);
    for (std::size_t i = 0; i < tiled.size(); ++i) {
      *files[tiled[i].index] = tiled[i].tile(number);
      if (!present.contains(i))
        list.skipped.push_back({tiled[i].tile(number).string() +
                                    ": not found, but other maps of the set have this " + list.tile_noun,
                                true});
    }
    if (present.size() < tiled.size()) continue;
    if (!set.copies.empty()) set.diffuse.file = set.copies.front().source;
    Job& job = list.jobs.emplace_back(Job{tiled.front().file.string(), std::to_string(number)});
    job.work = std::move(set);
  }
  return list;
}

}  // namespace

std::optional<Discovery> discovered_sets(const ConvertOptions& options) {
  if (options.folder.empty()) return std::nullopt;
  const Naming naming = options.names.empty() ? built_in_naming() : read_naming(options.names);
  WalkOptions walk;
  walk.recursive = options.recursive;
  walk.excluded = {options.output};
  if (!options.diagnose.empty()) walk.excluded.push_back(options.diagnose);
  walk.also = asset_extensions("");
  Discovery found = find_sets(options.folder, walk, naming);
  if (found.sets.empty() && found.problems.empty() && !found.others.empty())
    throw usage_error(display_path(options.folder) + ": no texture set found by file names, but " +
                      counted(found.others.size(), "asset") +
                      (found.others.size() == 1 ? ": " : ", such as ") + display_path(found.others.front()) +
                      " (--assets converts " + (found.others.size() == 1 ? "it" : "them") + ")");
  return found;
}

JobList set_jobs(const ConvertOptions& options, const ConversionChoice& workflow,
                 const TextureSetRequest& request, std::optional<Discovery> sets) {
  if (sets) return SetJobs(options, workflow, request, *std::move(sets)).list();
  SetWork set{request, options.output, options.diagnose, {}, copied_files(options, workflow), {}, {}};
  set.effect = effect_of(workflow, request);
  if (!set.copies.empty()) set.diffuse.file = set.copies.front().source;
  if (const std::vector<TiledFile> tiled = tiled_files(set); !tiled.empty()) return tile_jobs(set, tiled);
  JobList list;
  list.jobs.push_back({""});
  list.jobs.back().work = std::move(set);
  return list;
}

}  // namespace remap
