#include "texremap/plan/manifest.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json_field.hpp"
#include "core/system.hpp"
#include "remap/version.hpp"
#include "texture/content_hash.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

constexpr std::int64_t kFormat = 1;
constexpr std::string_view kCostFirst = "{\"cost\":";
constexpr std::size_t kLongestHead = 1 << 16;
constexpr std::int64_t kMostTile = 999'999'999;
constexpr const char* kChanged = "is incomplete or was edited (run texremap index again)";

// Returns true if a conversion may read the map. No conversion reads maps of normals or heights.
bool is_read(const FoundMap& map) {
  constexpr Role kCopied[] = {Role::kNormal, Role::kHeight,     Role::kCavity, Role::kTransmission,
                              Role::kIor,    Role::kSubsurface, Role::kOther};
  return std::ranges::any_of(map.meaning, [&](const ChannelMeaning& entry) {
    return std::ranges::find(kCopied, entry.role) == std::end(kCopied);
  });
}

// A ListedEntry is a set or an asset, with what its line of the manifest holds.
template <class Entry>
struct ListedEntry {
  const Entry& entry;
  std::vector<std::uintmax_t> sizes;  // sizes of its files, in order
  std::uintmax_t bytes = 0;
  std::uint64_t cost = 0;

  void add_file(const fs::path& root, const fs::path& file, bool is_read) {
    std::error_code failure;
    const std::uintmax_t size = fs::file_size(root / file, failure);
    if (failure)
      throw system_error(ErrorKind::kInput, display_path(file) + ": cannot be read", errno_of(failure));
    sizes.push_back(size);
    bytes += size;
    if (is_read) cost += size + kCostOfFile;
  }
};

// Refuses names that JSON cannot hold, or that read_manifest() refuses.
void require_listable(const fs::path& path) {
  if (!is_utf8(path.string()))
    throw input_error(display_path(path) +
                      ": the name is not UTF-8, so a manifest cannot list it (rename it)");
  if (const std::string fault = fault_of_relative(path.string()); !fault.empty())
    throw input_error(display_path(path) + ": the name " + fault + ", which a manifest refuses (rename it)");
}

fs::path place_of(const FoundSet& set) { return set.folder / set.name; }
const fs::path& place_of(const ListedAsset& asset) { return asset.path; }

ListedEntry<FoundSet> listed(const fs::path& root, const FoundSet& set) {
  ListedEntry<FoundSet> all{set, {}};
  require_listable(place_of(set));
  for (const FoundMap& map : set.maps) {
    require_listable(map.path);
    if (map.tiles.empty()) all.add_file(root, map.path, is_read(map));
    for (const auto& [number, file] : map.tiles) all.add_file(root, file, is_read(map));
  }
  return all;
}

ListedEntry<ListedAsset> listed(const fs::path& root, const ListedAsset& asset) {
  ListedEntry<ListedAsset> all{asset, {}};
  require_listable(asset.path);
  all.add_file(root, asset.path, true);
  for (const fs::path& file : asset.files) {
    require_listable(file);
    all.add_file(root, file, true);
  }
  return all;
}

std::string line_of(const ListedEntry<FoundSet>& listed) {
  const FoundSet& set = listed.entry;
  Json maps = Json::list();
  auto size = listed.sizes.begin();
  for (const FoundMap& map : set.maps) {
    Json roles = Json::object();
    for (const ChannelMeaning& entry : map.meaning)
      roles[std::string(name_of(kChannels, entry.channels))] = role_name(entry.role);
    Json json = {{"file", map.path.filename().string()}, {"habit", map.habit}, {"roles", roles}};
    if (map.tiles.empty()) json["bytes"] = *size++;
    for (const auto& [number, file] : map.tiles) json["tiles"].push_back(Json::list({number, *size++}));
    maps.push_back(json);
  }
  const Json json = {{"cost", listed.cost}, {"id", place_of(set).string()}, {"folder", set.folder.string()},
                     {"name", set.name},    {"bytes", listed.bytes},        {"maps", maps}};
  return json.dump() + '\n';
}

std::string line_of(const ListedEntry<ListedAsset>& listed) {
  const ListedAsset& asset = listed.entry;
  Json files = Json::list();
  auto size = listed.sizes.begin();
  files.push_back(Json::list({asset.path.string(), *size++}));
  for (const fs::path& file : asset.files) files.push_back(Json::list({file.string(), *size++}));
  const Json json = {{"cost", listed.cost},
                     {"asset", asset.path.string()},
                     {"prefix", asset.image_prefix},
                     {"bytes", listed.bytes},
                     {"files", files}};
  return json.dump() + '\n';
}

Json head_json(const ManifestHead& head) {
  return {{"remap_manifest", kFormat},
          {"version", head.version},
          {"root", head.root.string()},
          {"names", head.names},
          {std::string(name_of(kListedKinds, head.kind)), head.count},
          {"files", head.file_count},
          {"bytes", head.bytes},
          {"cost", head.cost},
          {"hash", head.hash}};
}

// Hashes the first line, except for the hash itself. The caller adds the other lines.
ContentHash hash_of_head(ManifestHead head) {
  head.hash.clear();
  ContentHash hash;
  hash.add(head_json(head).dump());
  return hash;
}

// An UnsafeName is a name in a manifest that leads out of the tree. Somebody may have written it there on
// purpose.
struct UnsafeName {
  std::string message;
};

class ManifestReader {
 public:
  explicit ManifestReader(const fs::path& path) : path_(path), file_(path), lines_(file_) {}
  TreeManifest read(const Part& part);

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw input_error(path_.string() + ": " + what); }
  ManifestHead read_head();
  void read_lines(const Part& part, TreeManifest& manifest, ContentHash& hash);
  void add_set(const Field& field, TreeManifest& tree) const;
  void add_asset(const Field& field, TreeManifest& tree) const;
  void add_rest(const Field& field, TreeManifest& tree) const;
  std::uint64_t cost_in(std::string_view line) const;
  // `checked` is safe_relative() or safe_name().
  fs::path safe(const Field& field, fs::path (*checked)(const std::string&, const std::string&)) const {
    const std::string& text = field.any_text();
    try {
      return checked(text, path_.string() + ": line " + std::to_string(lines_.number()));
    } catch (const Error& error) {
      throw UnsafeName{std::string(error.what()) + " (run texremap index again)"};
    }
  }

  const fs::path& path_;
  const InputFile file_;
  InputLines lines_;
};

ManifestHead ManifestReader::read_head() {
  const std::string_view line = lines_.next().value_or("");
  if (!line.starts_with("{\"remap_manifest\":") || line.size() > kLongestHead)
    refuse("is not a manifest (texremap index DIR -o FILE writes one)");
  const Json json = parse_json(line, path_.string());
  const Field field(json, path_.string());
  ManifestHead head;
  head.version = field["version"].text();
  if (const std::int64_t format = field["remap_manifest"].count(); format != kFormat)
    refuse("has format " + std::to_string(format) + ", but this texremap reads format " +
           std::to_string(kFormat) + " (run texremap index again)");
  if (head.version != kVersion)
    refuse("was written by texremap " + head.version + ", but this is texremap " + kVersion +
           " (run texremap index again)");
  head.root = field["root"].any_text();
  head.names = field["names"].text();
  head.kind = field.contains("assets") ? ListedKind::kAssets : ListedKind::kSets;
  head.count = static_cast<std::size_t>(field[std::string(name_of(kListedKinds, head.kind))].count());
  head.file_count = static_cast<std::size_t>(field["files"].count());
  head.bytes = static_cast<std::uintmax_t>(field["bytes"].count());
  head.cost = static_cast<std::uint64_t>(field["cost"].count());
  head.hash = field["hash"].text();
  return head;
}

std::uint64_t ManifestReader::cost_in(std::string_view line) const {
  std::uint64_t cost = 0;
  const char* const begin = line.data() + kCostFirst.size();
  if (std::from_chars(begin, line.data() + line.size(), cost).ec != std::errc()) refuse(kChanged);
  return cost;
}

void ManifestReader::add_asset(const Field& field, TreeManifest& tree) const {
  ListedAsset asset;
  asset.path = safe(field["asset"], safe_relative);
  asset.image_prefix = safe(field["prefix"], safe_name).string();
  field["files"].list(1, [&](const Field& file) {
    const fs::path path = safe(file.at(0, 2), safe_relative);
    tree.found.sizes[path] = static_cast<std::uintmax_t>(file.at(1, 2).count());
    if (path != asset.path) asset.files.push_back(path);
    return true;
  });
  if (!tree.found.sizes.contains(asset.path)) refuse(kChanged);
  tree.assets.push_back(std::move(asset));
}

void ManifestReader::add_set(const Field& field, TreeManifest& tree) const {
  FoundSet set;
  set.name = safe(field["name"], safe_name).string();
  set.folder = safe(field["folder"], safe_relative);
  const auto note_size = [&](const fs::path& file, const Field& bytes) {
    tree.found.sizes[file] = static_cast<std::uintmax_t>(bytes.count());
  };
  field["maps"].list(1, [&](const Field& entry) {
    FoundMap& map = set.maps.emplace_back();
    const std::string name = safe(entry["file"], safe_name).string();
    map.path = set.folder / name;
    map.habit = entry["habit"].any_text();
    const Field roles = entry["roles"];
    roles.require(roles.json().fields() != nullptr, "an object");
    for (const auto& [channels, role] : *roles.json().fields())
      map.meaning.push_back({value_named(kChannels, channels).value_or(Channels::kWhole),
                             Field(role, path_.string()).named(kRoles, "a role")});
    map.is_converted = has_roughness_or_specular(map.meaning);
    if (!entry.contains("tiles")) {
      note_size(map.path, entry["bytes"]);
      return true;
    }
    map.pattern = tile_pattern(name);
    if (!map.pattern) refuse(kChanged);
    entry["tiles"].list(1, [&](const Field& tile) {
      const std::int64_t number = tile.at(0, 2).count();
      if (number > kMostTile) refuse(kChanged);
      const fs::path file = set.folder / tile_name(*map.pattern, static_cast<int>(number));
      map.tiles[static_cast<int>(number)] = file;
      note_size(file, tile.at(1, 2));
      return true;
    });
    return true;
  });
  judge(set);
  tree.found.sets.push_back(std::move(set));
}

void ManifestReader::add_rest(const Field& field, TreeManifest& tree) const {
  if (field.contains("problem"))
    tree.found.problems.push_back({{}, field["problem"].any_text()});
  else
    tree.found.unrecognised.push_back(safe(field["unrecognised"], safe_relative));
}

TreeManifest ManifestReader::read(const Part& part) {
  TreeManifest manifest;
  manifest.head = read_head();
  ContentHash hash = hash_of_head(manifest.head);
  try {
    read_lines(part, manifest, hash);
  } catch (const UnsafeName& name) {
    throw input_error(name.message);
  } catch (const Error&) {
    refuse(kChanged);  // if a line cannot be read, the file has changed
  }
  if (hash.hex() != manifest.head.hash) refuse(kChanged);
  return manifest;
}

void ManifestReader::read_lines(const Part& part, TreeManifest& manifest, ContentHash& hash) {
  const auto add = [&](std::string_view line, auto adder) {
    const std::string context = path_.string();
    const Json json = parse_json(line, context);
    (this->*adder)(Field(json, context), manifest);
  };
  const auto add_entry =
      manifest.head.kind == ListedKind::kSets ? &ManifestReader::add_set : &ManifestReader::add_asset;
  std::uint64_t before = 0;
  while (const std::optional<std::string_view> line = lines_.next()) {
    hash.add(*line);
    if (!line->starts_with(kCostFirst)) {
      if (part.index == 1) add(*line, &ManifestReader::add_rest);
      continue;
    }
    const std::uint64_t cost = cost_in(*line);
    if (part_of_entry(before, cost, manifest.head, part.count) == part.index) {
      add(*line, add_entry);
      manifest.costs.push_back(cost);
    }
    before += cost;
  }
  if (!lines_.rest().empty()) refuse(kChanged);
}

// Lists the valid entries; the others become problems.
template <class Entry>
std::vector<ListedEntry<Entry>> listed_all(const fs::path& root, const std::vector<Entry>& entries,
                                           ManifestHead& head, std::vector<WalkProblem>& problems) {
  std::vector<ListedEntry<Entry>> all;
  for (const Entry& entry : entries) {
    try {
      all.push_back(listed(root, entry));
    } catch (const Error& error) {
      problems.push_back({place_of(entry), display_path(root) + "/" + error.what()});
      continue;
    }
    head.file_count += all.back().sizes.size();
    head.bytes += all.back().bytes;
    head.cost += all.back().cost;
  }
  head.count += all.size();
  return all;
}

}  // namespace

ManifestHead write_manifest(const fs::path& file, const fs::path& root, const std::string& names,
                            TreeManifest tree) {
  Discovery& found = tree.found;
  ManifestHead head;
  head.kind = tree.head.kind;
  head.version = kVersion;
  head.root = fs::absolute(root).lexically_normal();
  head.names = names;
  if (!is_utf8(head.root.string()))
    throw input_error(display_path(head.root) +
                      ": the name is not UTF-8, so a manifest cannot list it (rename it)");
  const std::vector<ListedEntry<FoundSet>> sets = listed_all(root, found.sets, head, found.problems);
  const std::vector<ListedEntry<ListedAsset>> assets = listed_all(root, tree.assets, head, found.problems);
  // The first line holds a hash of the other lines. They are made twice, because all of them may not fit into
  // memory.
  const auto make_lines = [&](const auto& take) {
    for (const ListedEntry<FoundSet>& set : sets) take(line_of(set));
    for (const ListedEntry<ListedAsset>& asset : assets) take(line_of(asset));
    for (const fs::path& image : found.unrecognised)
      take(Json({{"unrecognised", image.string()}}).dump() + '\n');
    for (const WalkProblem& problem : found.problems)
      take(Json({{"problem", problem.message}}).dump() + '\n');
  };
  ContentHash hash = hash_of_head(head);
  make_lines([&](const std::string& line) { hash.add(std::string_view(line).substr(0, line.size() - 1)); });
  head.hash = hash.hex();
  NewFile manifest(file);
  manifest.add(head_json(head).dump() + '\n');
  make_lines([&](const std::string& line) { manifest.add(line); });
  manifest.commit();
  return head;
}

std::size_t part_of_entry(std::uint64_t cost_before, std::uint64_t cost, const ManifestHead& head,
                          std::size_t count) {
  if (head.cost == 0) return 1;
  const double middle = static_cast<double>(cost_before) + 0.5 * static_cast<double>(cost);
  const double place = middle / static_cast<double>(head.cost) * static_cast<double>(count);
  return std::min(static_cast<std::size_t>(place), count - 1) + 1;
}

TreeManifest read_manifest(const fs::path& file, const Part& part) { return ManifestReader(file).read(part); }

void require_as_listed(const ListedSizes& files) {
  for (const auto& [file, bytes] : files) {
    std::error_code failure;
    const std::uintmax_t size = fs::file_size(file, failure);
    if (failure)
      throw Error(ErrorKind::kInput,
                  file.string() + ": is in the manifest, but cannot be read: " +
                      std::strerror(errno_of(failure)) + " (run texremap index again)",
                  errno_of(failure));
    if (size != bytes)
      throw input_error(file.string() + ": has " + std::to_string(size) + " bytes, but the manifest lists " +
                        std::to_string(bytes) + " (run texremap index again)");
  }
}

}  // namespace remap
