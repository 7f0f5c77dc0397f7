#include <algorithm>
#include <set>

#include "check/material.hpp"
#include "core/errors.hpp"
#include "sets/discovery.hpp"
#include "sets/name_pieces.hpp"

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

}  // namespace remap
