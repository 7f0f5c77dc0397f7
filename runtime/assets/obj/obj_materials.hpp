// Materials of MTL files as materials of a new glTF file, with their textures.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "assets/document/asset.hpp"
#include "assets/mtl/mtl_libraries.hpp"
#include "assets/mtl/mtl_material.hpp"
#include "assets/obj/obj_mesh.hpp"
#include "assets/obj/obj_textures.hpp"

namespace remap {

struct SceneMaterial {
  Json json;
  bool has_texture = false;
};

class ObjMaterials {
 public:
  // All must outlive it. Reports of materials, and warnings, are added to `conversion`.
  ObjMaterials(const AssetOptions& options, const AssetResources& resources, const MtlLibraries& libraries,
               GltfTextures& textures, AssetConversion& conversion);
  ~ObjMaterials();

  // Materials of an OBJ file in their order. One that no file has counts as white.
  std::vector<SceneMaterial> converted(const std::vector<ObjMaterialName>& names);
  // The extensions of materials that are used.
  const std::set<std::string>& extensions() const noexcept { return extensions_; }

 private:
  struct Planned;
  struct ConvertedImages;

  Json material_of(const ObjMaterialName& name, AssetMaterial& report);
  Json converted_block(MtlLibrary& library, const MtlBlock& block, AssetMaterial& report);
  static void describe(const Planned& planned);
  void set_reflection(Planned& planned);
  void set_metal_rough(Planned& planned);
  void set_specular_level(Planned& planned);
  bool is_glass(Planned& planned) const;
  void set_glass(Planned& planned);
  void set_core(Planned& planned, const MtlReflection& reflection);
  void set_dielectric(Planned& planned, const MtlReflection& reflection);
  void set_converted_maps(Planned& planned, const MtlReflection& reflection, bool as_dielectric);
  ConvertedImages& converted_images(Planned& planned, const MtlReflection& reflection, bool as_dielectric,
                                    const MtlMap& data_map);
  void set_extension(Planned& planned, std::string_view name, Json value);
  void keep_diffuse_map(Planned& planned);
  double alpha_of(const MtlCover& cover) const;
  bool is_transparent(const Planned& planned) const;
  void set_opacity(Planned& planned);
  bool add_opacity(Planned& planned);
  void set_emission(Planned& planned);
  void set_normals(Planned& planned);
  std::shared_ptr<const ImagePixels> packed_metal_rough(Planned& planned, const MtlMap** model);
  std::size_t base_image_of(Planned& planned);

  const AssetOptions& options_;
  const AssetResources& resources_;
  const MtlLibraries& libraries_;
  GltfTextures& textures_;
  AssetConversion& conversion_;
  bool reads_tr_ = true;
  std::set<std::string> extensions_;
  std::map<std::string, std::size_t> composed_;  // images of color with alpha, by both files
  std::map<std::string, std::shared_ptr<ConvertedImages>> converted_;  // by key_of() and opacity
};

}  // namespace remap
