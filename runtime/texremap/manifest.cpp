#include "texremap/manifest.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <set>

#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json_field.hpp"
#include "remap/version.hpp"
#include "texture/content_hash.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

constexpr std::int64_t kFormat = 1;
constexpr std::string_view kCostFirst = "{\"cost\":";
constexpr std::size_t kLongestHead = 1 << 16;
constexpr const char* kChanged = "is incomplete, or was changed since it was written (texremap index again)";

// Whether a conversion may read the channels: of a map of normals or heights none does.
bool is_read(const FoundMap& map) {
  constexpr Role kCopied[] = {Role::kNormal, Role::kHeight,     Role::kCavity, Role::kTransmission,
                              Role::kIor,    Role::kSubsurface, Role::kOther};
  return std::ranges::any_of(map.meaning, [&](const ChannelMeaning& entry) {
    return std::ranges::find(kCopied, entry.role) == std::end(kCopied);
  });
}

// A set, and what stands in its line.
struct ListedSet {
  const FoundSet& set;
  std::vector<std::uintmax_t> sizes;  // of the files of all maps, in order
  std::uintmax_t bytes = 0;
  std::uint64_t cost = 0;

  void add_file(const fs::path& root, const fs::path& file, bool is_read) {
    std::error_code failure;
    const std::uintmax_t size = fs::file_size(root / file, failure);
    if (failure) throw system_error(ErrorKind::kInput, shown(file) + ": cannot be read", failure.value());
    sizes.push_back(size);
    bytes += size;
    if (is_read) cost += size + kCostOfFile;
  }
};

void require_utf8(const FoundSet& set) {
  const auto require = [](const fs::path& path) {
    if (!is_utf8(path.string()))
      throw input_error(shown(path) + ": the name is no UTF-8, which a manifest cannot hold (rename it)");
  };
  require(set.folder / set.name);
  for (const FoundMap& map : set.maps) require(map.path);
}

ListedSet listed(const fs::path& root, const FoundSet& set) {
  require_utf8(set);
  ListedSet all{set, {}};
  for (const FoundMap& map : set.maps) {
    if (map.tiles.empty()) all.add_file(root, map.path, is_read(map));
    for (const Tile& tile : map.tiles) all.add_file(root, tile.path, is_read(map));
  }
  return all;
}

std::string line_of(const ListedSet& listed) {
  const FoundSet& set = listed.set;
  Json maps = Json::list();
  auto size = listed.sizes.begin();
  for (const FoundMap& map : set.maps) {
    Json roles = Json::object();
    for (const ChannelMeaning& entry : map.meaning)
      roles[std::string(name_of(kChannels, entry.channels))] = role_name(entry.role);
    Json json = {{"file", map.path.filename().string()}, {"habit", map.habit}, {"roles", roles}};
    if (map.tiles.empty()) json["bytes"] = *size++;
    for (const Tile& tile : map.tiles) json["tiles"].push_back(Json::list({tile.number, *size++}));
    maps.push_back(json);
  }
  const Json json = {{"cost", listed.cost},           {"id", (set.folder / set.name).string()},
                     {"folder", set.folder.string()}, {"name", set.name},
                     {"bytes", listed.bytes},         {"maps", maps}};
  return json.dump() + '\n';
}

Json head_json(const ManifestHead& head) {
  return {{"remap_manifest", kFormat}, {"version", head.version}, {"root", head.root.string()},
          {"names", head.names},       {"sets", head.set_count},  {"files", head.file_count},
          {"bytes", head.bytes},       {"cost", head.cost},       {"hash", head.hash}};
}

// Of what the first line says, but for the hash itself; the other lines are added.
ContentHash hash_of_head(ManifestHead head) {
  head.hash.clear();
  ContentHash hash;
  hash.add(head_json(head).dump());
  return hash;
}

class ManifestReader {
 public:
  explicit ManifestReader(const fs::path& path) : path_(path), file_(path, std::ios::binary) {
    require_regular_file(path);
    if (!file_) throw system_error(ErrorKind::kInput, path.string() + ": cannot be read", errno);
  }
  SetManifest read(const Part& part);

 private:
  [[noreturn]] void refuse(const std::string& what) const { throw input_error(path_.string() + ": " + what); }
  ManifestHead read_head();
  void read_lines(const Part& part, SetManifest& manifest, ContentHash& hash);
  void add_set(const std::string& line, SetManifest& manifest) const;
  void add_rest(const std::string& line, SetManifest& manifest) const;
  std::uint64_t cost_in(const std::string& line) const;

  const fs::path& path_;
  std::ifstream file_;
};

ManifestHead ManifestReader::read_head() {
  std::string line;
  std::getline(file_, line);
  if (!line.starts_with("{\"remap_manifest\":") || line.size() > kLongestHead)
    refuse("is no manifest (texremap index DIR -o FILE writes one)");
  const Json json = parse_json(line, path_.string());
  const Field field(json, path_.string());
  ManifestHead head;
  head.version = field["version"].text();
  if (const std::int64_t format = field["remap_manifest"].count(); format != kFormat)
    refuse("is of format " + std::to_string(format) + ", this texremap reads format " +
           std::to_string(kFormat) + " (texremap index again)");
  if (head.version != kVersion)
    refuse("is of version " + head.version + " of texremap, this is " + kVersion + " (texremap index again)");
  head.root = field["root"].any_text();
  head.names = field["names"].text();
  head.set_count = static_cast<std::size_t>(field["sets"].count());
  head.file_count = static_cast<std::size_t>(field["files"].count());
  head.bytes = static_cast<std::uintmax_t>(field["bytes"].count());
  head.cost = static_cast<std::uint64_t>(field["cost"].count());
  head.hash = field["hash"].text();
  return head;
}

std::uint64_t ManifestReader::cost_in(const std::string& line) const {
  std::uint64_t cost = 0;
  const char* const begin = line.data() + kCostFirst.size();
  if (std::from_chars(begin, line.data() + line.size(), cost).ec != std::errc()) refuse(kChanged);
  return cost;
}

void ManifestReader::add_set(const std::string& line, SetManifest& manifest) const {
  const std::string place = path_.string();
  const Json json = parse_json(line, place);
  const Field field(json, place);
  FoundSet set;
  set.name = field["name"].any_text();
  set.folder = field["folder"].any_text();
  const auto note_size = [&](const fs::path& file, const Field& bytes) {
    manifest.found.sizes[file] = static_cast<std::uintmax_t>(bytes.count());
  };
  field["maps"].list(1, [&](const Field& entry) {
    FoundMap& map = set.maps.emplace_back();
    const std::string& name = entry["file"].any_text();
    map.path = set.folder / name;
    map.habit = entry["habit"].any_text();
    const Field roles = entry["roles"];
    roles.require(roles.json().fields() != nullptr, "an object");
    for (const auto& [channels, role] : *roles.json().fields())
      map.meaning.push_back({value_named(kChannels, channels).value_or(Channels::kWhole),
                             roles[channels].named(kRoles, "a role")});
    map.is_converted = has_roughness_or_specular(map.meaning);
    if (!entry.contains("tiles")) {
      note_size(map.path, entry["bytes"]);
      return true;
    }
    map.pattern = tile_pattern(name);
    entry["tiles"].list(1, [&](const Field& tile) {
      const int number = static_cast<int>(tile.at(0, 2).count());
      map.tiles.push_back({number, set.folder / tile_name(*map.pattern, number)});
      note_size(map.tiles.back().path, tile.at(1, 2));
      return true;
    });
    return true;
  });
  judge(set);
  manifest.found.sets.push_back(std::move(set));
}

void ManifestReader::add_rest(const std::string& line, SetManifest& manifest) const {
  const Json json = parse_json(line, path_.string());
  const Field field(json, path_.string());
  if (field.contains("problem"))
    manifest.found.problems.push_back({{}, field["problem"].any_text()});
  else
    manifest.found.unrecognised.emplace_back(field["unrecognised"].any_text());
}

SetManifest ManifestReader::read(const Part& part) {
  SetManifest manifest{read_head(), {}, {}};
  ContentHash hash = hash_of_head(manifest.head);
  try {
    read_lines(part, manifest, hash);
  } catch (const Error&) {
    refuse(kChanged);  // a line that makes no sense is not one that was written
  }
  if (hash.hex() != manifest.head.hash) refuse(kChanged);
  return manifest;
}

void ManifestReader::read_lines(const Part& part, SetManifest& manifest, ContentHash& hash) {
  std::uint64_t before = 0;
  for (std::string line; std::getline(file_, line);) {
    hash.add(line);
    if (!line.starts_with(kCostFirst)) {
      if (part.index == 1) add_rest(line, manifest);
      continue;
    }
    const std::uint64_t cost = cost_in(line);
    if (part_of_set(before, cost, manifest.head, part.count) == part.index) {
      add_set(line, manifest);
      manifest.costs.push_back(cost);
    }
    before += cost;
  }
}

}  // namespace

ManifestHead write_manifest(const fs::path& file, const fs::path& root, const std::string& names,
                            Discovery found) {
  ManifestHead head;
  head.version = kVersion;
  head.root = fs::absolute(root).lexically_normal();
  head.names = names;
  if (!is_utf8(head.root.string()))
    throw input_error(shown(head.root) + ": the name is no UTF-8, which a manifest cannot hold (rename it)");
  std::vector<ListedSet> sets;
  for (const FoundSet& set : found.sets) {
    try {
      sets.push_back(listed(root, set));
    } catch (const Error& error) {
      found.problems.push_back({set.folder / set.name, shown(root) + "/" + error.what()});
      continue;
    }
    head.file_count += sets.back().sizes.size();
    head.bytes += sets.back().bytes;
    head.cost += sets.back().cost;
  }
  head.set_count = sets.size();
  // The hash stands before the lines, which are made twice rather than kept: a manifest may have gigabytes.
  const auto make_lines = [&](const auto& take) {
    for (const ListedSet& set : sets) take(line_of(set));
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

std::size_t part_of_set(std::uint64_t cost_before, std::uint64_t cost, const ManifestHead& head,
                        std::size_t count) {
  if (head.cost == 0) return 1;
  const double middle = static_cast<double>(cost_before) + 0.5 * static_cast<double>(cost);
  const double place = middle / static_cast<double>(head.cost) * static_cast<double>(count);
  return std::min(static_cast<std::size_t>(place), count - 1) + 1;
}

SetManifest read_manifest(const fs::path& file, const Part& part) { return ManifestReader(file).read(part); }

}  // namespace remap
