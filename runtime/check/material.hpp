// This file describes a material as its files do: maps with roles and texels, factors, and other statements.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/files.hpp"
#include "sets/naming.hpp"
#include "texture/image_library.hpp"

namespace remap {

// A TexelSample holds texels of an image as they are stored. Integers become 0 to 1. A large image is sampled
// in squares on an even grid, so that neighbouring texels stay neighbours.
struct TexelSample {
  int columns = 0;
  int rows = 0;
  std::vector<std::vector<float>> channels;  // row-major, one per channel of `layout`
  ImageLayout layout;                        // layout of the file
  // These members count texels of floating-point channels.
  std::size_t nan_count = 0, negative_count = 0, above_one_count = 0;

  bool has_floats() const;
};

// Reads an image of any size in bands. Throws kInput with the file's name.
TexelSample sample_of(const std::filesystem::path& file);
// Reads a texture of an asset in the same way. Like conversions of assets, it reads WebP with alpha.
TexelSample sample_of_texture(const std::filesystem::path& file);

// A MaterialMap is a file of a material, or an image inside one.
struct MaterialMap {
  std::filesystem::path file;
  std::string shown;  // name in messages: the file, or `model.glb: image 2 (metal)`
  std::string name;   // file name, which may show a convention
  std::shared_ptr<const TexelSample> texels = {};  // null if the image cannot be read
  bool is_embedded = false;                        // true if `file` is a temporary copy
  int tile = 0;                                    // number of the tile; 0 for a map without tiles
  std::vector<MaterialMap> others = {};  // further images of the texture; the first readable image is used
};

// A MaterialUse is one role of a material.
struct MaterialUse {
  Role role = Role::kOther;
  std::size_t map = 0;  // index into CheckedMaterial::maps
  Channels channels = Channels::kWhole;
  std::string slot;             // name of the map in an asset, such as `metallicRoughnessTexture`
  std::vector<double> factors;  // numbers by which an asset multiplies the map; may be empty
  std::string factor_name;      // such as `metallicFactor`
  bool is_neighbour = false;    // true if it belongs to another material in the folder, for comparison
  // This is the UV set that glTF uses for the map.
  std::size_t tex_coord = 0;
  std::string transform = {};  // text of KHR_texture_transform; may be empty
};

// A GltfStatements holds the parts of a glTF material besides its maps (names and defaults of glTF 2.0 and
// its extensions).
struct GltfStatements {
  std::set<std::string> extensions;  // extensions that change the look of the material
  double metallic_factor = 1.0;
  std::optional<double> ior;              // KHR_materials_ior
  std::optional<double> specular_factor;  // KHR_materials_specular
  bool has_specular_map = false;
  bool transmits = false;
  bool has_volume = false;  // core glTF has no place for the index of a volume or of dispersion
};

enum class MaterialKind { kFolder, kGltf, kMtl };

struct CheckedMaterial {
  MaterialKind kind = MaterialKind::kFolder;
  std::string name;             // `assets/robot`, `model.glb: material "Paint"`
  std::filesystem::path path;   // a folder or an asset file
  std::filesystem::path below;  // folder of `path`, relative to the checked path; may be empty
  std::vector<MaterialMap> maps;
  std::vector<MaterialUse> uses;
  std::vector<MaterialUse> unread;  // uses that a factor of 0 turns off, so no rule applies to them
  GltfStatements gltf;
  std::vector<std::string> failures;  // statements of MTL that a conversion refuses
  std::vector<double> exponents;      // each Ns of an MTL file

  // Reads the texels of all maps. Returns a message for each image that cannot be read.
  std::vector<std::string> read_maps();
  // Returns the channel that a use with one channel reads. Returns nothing for a color, or if the image lacks
  // the channel.
  std::optional<std::size_t> channel(const MaterialUse& use) const;
  // Returns the stored values of the channel that a use reads.
  const std::vector<float>* plane(const MaterialUse& use) const;
  // Returns the three channels of a use, or nothing if the image has fewer.
  std::vector<const std::vector<float>*> colors(const MaterialUse& use) const;
  const TexelSample* texels(const MaterialUse& use) const { return maps[use.map].texels.get(); }
  // Returns true if every texel is metal. Metal reflects its base color and transmits nothing.
  bool is_all_metal() const;
  // Returns true if two uses have texels at the same places.
  bool same_size(const MaterialUse& a, const MaterialUse& b) const;
};

// A FoundMaterials holds the materials of a folder and its subfolders: sets of maps, and glTF and MTL assets.
struct FoundMaterials {
  std::vector<CheckedMaterial> materials;
  std::vector<std::string> problems;  // a message for each file or folder that cannot be read
  // Keeps images that are part of assets on disk while the materials are in use.
  std::shared_ptr<const ScratchFolder> embedded;
};

// Finds the materials of a folder, a glTF or MTL file, or a single map. Throws kInput if `path` does not
// exist.
FoundMaterials materials_of(const std::filesystem::path& path, const Naming& naming);

// Adds the materials of one asset.
void add_gltf(const std::filesystem::path& file, FoundMaterials& found);
void add_mtl(const std::filesystem::path& file, FoundMaterials& found);

}  // namespace remap
