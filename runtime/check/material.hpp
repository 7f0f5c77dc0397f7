// A material as its files describe it: maps with their roles and texels, factors, and what an asset says
// besides.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/scratch_folder.hpp"
#include "sets/naming.hpp"
#include "texture/image_layout.hpp"

namespace remap {

// Texels of an image as they are stored; whole numbers from 0 to 1. A large image is an even grid of squares,
// so that neighbours are neighbours.
struct TexelSample {
  int columns = 0;
  int rows = 0;
  std::vector<std::vector<float>> channels;  // row-major, as many as `layout` has
  ImageLayout layout;                        // of the file
  // Counts over all texels of floating-point channels.
  std::size_t nan_count = 0, negative_count = 0, above_one_count = 0;

  bool has_floats() const;
};

// Reads an image of any size in bands. Throws kInput, naming the file.
TexelSample sample_of(const std::filesystem::path& file);
// The same of a texture of an asset: WebP with alpha, too, which only conversions of assets read.
TexelSample sample_of_texture(const std::filesystem::path& file);

// A file of a material, or an image that is part of one.
struct MaterialMap {
  std::filesystem::path file;
  std::string shown;                               // in messages: the file, or `model.glb: image 2 (metal)`
  std::string name;                                // what may tell of a convention: the name of the file
  std::shared_ptr<const TexelSample> texels = {};  // null where the image cannot be read
  bool is_embedded = false;                        // `file` is a copy that goes when the program ends
  int tile = 0;                                    // number; 0 for a map without tiles
  std::vector<MaterialMap> others = {};  // other images of the texture: the first that can be read counts
};

// One role of a material.
struct MaterialUse {
  Role role = Role::kOther;
  std::size_t map = 0;  // index into CheckedMaterial::maps
  Channels channels = Channels::kWhole;
  std::string slot;             // where an asset names the map: `metallicRoughnessTexture`
  std::vector<double> factors;  // that an asset multiplies the map by; empty for none
  std::string factor_name;      // `metallicFactor`
  bool is_neighbour = false;    // of another material in the same folder: compared with, not judged
  // The place of the map on the surface (glTF).
  std::size_t tex_coord = 0;
  std::string transform = {};  // KHR_texture_transform as it stands; empty for none
};

// Statements of a glTF material besides its maps (names and defaults of glTF 2.0 and its extensions).
struct GltfStatements {
  std::set<std::string> extensions;  // that change what the material looks like
  double metallic_factor = 1.0;
  std::optional<double> ior;              // KHR_materials_ior
  std::optional<double> specular_factor;  // KHR_materials_specular
  bool has_specular_map = false;
  bool transmits = false;
  bool has_volume = false;  // or dispersion, whose index of refraction cannot go into core
};

// A material of a Wavefront MTL file.
struct Exponent {
  std::string material;
  double value = 0.0;  // Ns
};

enum class MaterialKind { kFolder, kGltf, kMtl };

struct CheckedMaterial {
  MaterialKind kind = MaterialKind::kFolder;
  std::string name;             // `assets/robot`, `model.glb: material "Paint"`
  std::filesystem::path path;   // a folder or an asset file
  std::filesystem::path below;  // its folder, relative to the checked path; empty for the checked path itself
  std::vector<MaterialMap> maps;
  std::vector<MaterialUse> uses;
  std::vector<MaterialUse> unread;  // that a factor of 0 turns off: nothing in them can be wrong
  GltfStatements gltf;
  std::vector<std::string> failures;  // statements of MTL that a conversion refuses
  std::vector<Exponent> exponents;    // of all materials of an MTL file, with the first of them

  // Reads the texels of all maps. Returns a message for each image that cannot be read.
  std::vector<std::string> read_maps();
  // The channel of the image that a use with one channel reads; none for a color, and where the image lacks
  // it.
  std::optional<std::size_t> channel(const MaterialUse& use) const;
  // Its values, as stored.
  const std::vector<float>* plane(const MaterialUse& use) const;
  // The three channels of a use; empty where the image has fewer.
  std::vector<const std::vector<float>*> colors(const MaterialUse& use) const;
  const TexelSample* texels(const MaterialUse& use) const { return maps[use.map].texels.get(); }
  // Whether every texel is metal, which has the base color as its reflectance and transmits nothing.
  bool is_all_metal() const;
  // Whether two uses have texels at the same places.
  bool same_size(const MaterialUse& a, const MaterialUse& b) const;
};

// The materials of a folder and its subfolders, and of assets in them: sets of maps by their names, glTF,
// MTL.
struct FoundMaterials {
  std::vector<CheckedMaterial> materials;
  std::vector<std::string> problems;  // a message for each file or folder that cannot be read
  // Keeps images that are part of assets on disk while the materials are in use.
  std::shared_ptr<const ScratchFolder> embedded;
};

// The materials of a folder, of a glTF or MTL file, or of a map alone. Throws kInput if `path` does not
// exist.
FoundMaterials materials_of(const std::filesystem::path& path, const Naming& naming);

// Adds the materials of one asset.
void add_gltf(const std::filesystem::path& file, FoundMaterials& found);
void add_mtl(const std::filesystem::path& file, FoundMaterials& found);

}  // namespace remap
