#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "assets/document/mtl_document.hpp"
#include "assets/mtl/mtl_libraries.hpp"
#include "assets/mtl/mtl_material.hpp"
#include "check/material.hpp"
#include "core/errors.hpp"
#include "core/input_file.hpp"
#include "core/plain_text.hpp"
#include "sets/discovery.hpp"
#include "sets/folder_walk.hpp"
#include "sets/naming.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

std::string extension_of(const fs::path& file) { return lower(file.extension().string()); }

bool is_asset(const fs::path& file) {
  const std::string extension = extension_of(file);
  return extension == ".gltf" || extension == ".glb" || extension == ".mtl";
}

void add_asset(const fs::path& file, FoundMaterials& found) {
  try {
    extension_of(file) == ".mtl" ? add_mtl(file, found) : add_gltf(file, found);
  } catch (const Error& error) {
    found.problems.push_back(error.what());
  }
}

// Adds a set. Each tile of a map is a separate image.
void add_set(const fs::path& root, const FoundSet& set, FoundMaterials& found) {
  CheckedMaterial material;
  material.path = root / set.folder;
  material.below = set.folder;
  material.name = display_path(root / set.folder / set.name);
  for (const FoundMap& map : set.maps) {
    for (const auto& [number, path] : map.tiles.empty() ? Tiles{{0, map.path}} : map.tiles) {
      for (const ChannelMeaning& entry : map.meaning)
        material.uses.push_back({entry.role, material.maps.size(), entry.channels, "", {}, "", false});
      const fs::path file = root / path;
      material.maps.push_back(
          {.file = file, .shown = file.string(), .name = file.filename().string(), .tile = number});
    }
  }
  found.materials.push_back(std::move(material));
}

bool same_folder(const fs::path& a, const fs::path& b) {
  return (a / "").lexically_normal() == (b / "").lexically_normal();
}

// Adds roughness maps of sets in the same folder to asset materials, because these maps may contradict each
// other.
void add_neighbours(FoundMaterials& found) {
  for (CheckedMaterial& material : found.materials) {
    if (material.kind != MaterialKind::kGltf) continue;
    for (const CheckedMaterial& set : found.materials) {
      if (set.kind != MaterialKind::kFolder || !same_folder(set.path, material.path.parent_path())) continue;
      for (const MaterialUse& use : set.uses) {
        const MaterialMap& map = set.maps[use.map];
        const bool is_own = std::ranges::any_of(material.maps, [&](const MaterialMap& own) {
          return own.file.lexically_normal() == map.file.lexically_normal();
        });
        if (is_own || !is_roughness(use.role)) continue;
        material.uses.push_back(use);
        material.uses.back().map = material.maps.size();
        material.uses.back().is_neighbour = true;
        material.maps.push_back(map);
      }
    }
  }
}

// Removes maps from sets if an asset uses them. The asset states how it uses them, so they are not checked by
// their names.
void remove_used_by_assets(FoundMaterials& found) {
  std::set<fs::path> used;
  for (const CheckedMaterial& material : found.materials)
    if (material.kind != MaterialKind::kFolder)
      for (const MaterialMap& map : material.maps) {
        used.insert(map.file.lexically_normal());
        for (const MaterialMap& other : map.others) used.insert(other.file.lexically_normal());
      }
  for (CheckedMaterial& material : found.materials)
    if (material.kind == MaterialKind::kFolder)
      std::erase_if(material.uses, [&](const MaterialUse& use) {
        return used.contains(material.maps[use.map].file.lexically_normal());
      });
}

void add_folder(const fs::path& folder, const Naming& naming, FoundMaterials& found) {
  WalkOptions options;
  options.also = {"gltf", "glb", "mtl"};
  const Discovery discovery = find_sets(folder, options, naming);
  for (const WalkProblem& problem : discovery.problems) found.problems.push_back(problem.message);
  for (const FoundSet& set : discovery.sets) add_set(folder, set, found);
  for (const fs::path& asset : discovery.others) {
    const std::size_t first = found.materials.size();
    add_asset(folder / asset, found);
    for (std::size_t i = first; i < found.materials.size(); ++i)
      found.materials[i].below = asset.parent_path();
  }
  remove_used_by_assets(found);
  add_neighbours(found);
  std::erase_if(found.materials, [](const CheckedMaterial& material) {
    return material.kind == MaterialKind::kFolder && material.uses.empty();
  });
}

}  // namespace

FoundMaterials materials_of(const fs::path& path, const Naming& naming) {
  FoundMaterials found;
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    add_folder(path, naming, found);
  } else if (!fs::exists(path, ignored)) {
    throw input_error(display_path(path) + ": does not exist (check the path)");
  } else if (is_asset(path)) {
    add_asset(path, found);
  } else {
    const std::vector<NameReading> readings = naming.read(path.stem().string());
    if (readings.empty())
      throw input_error(display_path(path) +
                        ": cannot detect the kind of map from its name (rename it, such as "
                        "wood_Roughness.png, or add --names FILE)");
    CheckedMaterial material;
    material.path = path;
    material.name = display_path(path);
    for (const ChannelMeaning& entry : readings.front().meaning)
      material.uses.push_back({entry.role, 0, entry.channels, "", {}, "", false});
    material.maps.push_back({path, path.string(), path.filename().string()});
    found.materials.push_back(std::move(material));
  }
  return found;
}

namespace {

// These are the words of lines with maps, in lower case.
constexpr NamedValues<Role, 11> kMapLines = {{{Role::kDiffuse, "map_kd"},
                                              {Role::kSpecular, "map_ks"},
                                              {Role::kOther, "map_ns"},
                                              {Role::kRoughness, "map_pr"},
                                              {Role::kMetallic, "map_pm"},
                                              {Role::kOpacity, "map_d"},
                                              {Role::kEmissive, "map_ke"},
                                              {Role::kHeight, "map_bump"},
                                              {Role::kHeight, "bump"},
                                              {Role::kNormal, "norm"},
                                              {Role::kNormal, "map_kn"}}};

Channels channels_of(const MtlMap& map) {
  switch (map.channel) {
    case 'r':
      return Channels::kRed;
    case 'g':
      return Channels::kGreen;
    case 'b':
      return Channels::kBlue;
    case 'm':
      return Channels::kAlpha;
    default:
      return Channels::kWhole;
  }
}

// Returns true if any program uses the highlight of a material. It needs illumination of highlights, and Ks
// above 0, because Ks multiplies its map.
bool has_highlight(const MtlSurface& surface) {
  const bool is_black = surface.specular && *surface.specular == std::array<double, 3>{};
  return surface.illumination.value_or(2.0) >= 2.0 && !is_black;
}

void add_map(const MtlMap& map, std::string_view word, Role role, bool is_read, CheckedMaterial& material) {
  const fs::path path = material.path.parent_path() / fs::path(map.file).relative_path();
  std::vector<MaterialUse>& uses = is_read ? material.uses : material.unread;
  uses.push_back({role, material.maps.size(), channels_of(map), std::string(word), {}, "", false});
  material.maps.push_back({path, path.string(), path.filename().string()});
}

// Reads a material as conversions do, and records what they refuse.
MtlSurface read_block(const MtlDocument& document, const MtlBlock& block, MtlMaker maker,
                      CheckedMaterial& material) {
  const auto attempt = [&](const auto& step) {
    try {
      step();
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInput) throw;
      material.failures.emplace_back(error.what());
    }
  };
  MtlSurface surface;
  std::vector<std::string> ignored;
  attempt([&] { read_mtl_surface(document, block, maker, surface, ignored); });
  attempt([&] { (void)read_mtl_cover(document, block, maker, ignored); });
  return surface;
}

// Returns the role of a line, which depends on the maker of the file. `written` is the role in files of the
// specification.
Role role_of(std::string_view word, Role written, MtlMaker maker) {
  if (maker == MtlMaker::kText) return written;
  const bool is_blender = maker != MtlMaker::kNvdiffrec;
  if (is_blender && word == "map_ns") return Role::kRoughness;
  if (is_blender && word == "map_refl") return Role::kMetallic;
  if (!is_blender && word == "map_ks") return Role::kOther;
  return written;
}

}  // namespace

void add_mtl(const fs::path& file, FoundMaterials& found) {
  const std::string text = mtl_text(MemorySource(read_file(file)), display_path(file));
  const MtlDocument document(text, display_path(file));
  const MtlMaker maker = maker_of(document);
  std::vector<double> exponents;
  const std::size_t first = found.materials.size();
  for (const MtlBlock& block : document.materials()) {
    CheckedMaterial& material = found.materials.emplace_back();
    const std::string name = "material \"" + plain(block.name) + "\"";
    material.kind = MaterialKind::kMtl;
    material.path = file;
    material.name = display_path(file) + ": " + name;
    const MtlSurface surface = read_block(document, block, maker, material);
    const bool shines = maker != MtlMaker::kText || has_highlight(surface);
    for (std::size_t i = block.first; i < block.last; ++i) {
      const MtlStatement& statement = document.statements()[i];
      const std::string word = document.word(statement);
      const std::vector<TextSpan> words = document.words(statement);
      if (maker == MtlMaker::kText && word == "ns" && !words.empty() && shines)
        if (const auto value = mtl_number(document.raw(words.front()))) exponents.push_back(*value);
      const std::optional<Role> written = value_named(kMapLines, word);
      if (!written) continue;
      if (const MtlMap map = read_mtl_map(document, i); !map.file.empty())
        add_map(map, word, role_of(word, *written, maker),
                map.strength != 0.0 && (shines || *written != Role::kSpecular), material);
    }
  }
  if (first < found.materials.size()) found.materials[first].exponents = std::move(exponents);
}

}  // namespace remap
