// This file converts materials of MTL files to materials of a new glTF file, with their textures.
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
  // All arguments must outlive this object. It adds reports about materials, and warnings, to `conversion`.
  ObjMaterials(const AssetOptions& options, const AssetResources& resources, const MtlLibraries& libraries,
               GltfTextures& textures, AssetConversion& conversion);
  ~ObjMaterials();

  // Returns the materials of an OBJ file in their order. A material that no file defines is white.
  std::vector<SceneMaterial> converted(const std::vector<std::optional<std::string>>& names);
  // Returns the extensions that materials use.
  const std::set<std::string>& extensions() const noexcept { return extensions_; }

 private:
  struct MaterialDraft;
  struct ConvertedImages;

  Json material_of(const std::optional<std::string>& name, AssetMaterial& report);
  Json converted_block(MtlLibrary& library, const MtlBlock& block, AssetMaterial& report);
  static void describe(const MaterialDraft& draft);
  void set_reflection(MaterialDraft& draft);
  void set_metal_rough(MaterialDraft& draft);
  void set_specular_level(MaterialDraft& draft);
  bool is_glass(MaterialDraft& draft) const;
  void set_glass(MaterialDraft& draft);
  void set_core(MaterialDraft& draft, const LegacyMaterial& factors);
  void set_dielectric(MaterialDraft& draft, const LegacyMaterial& factors);
  void set_converted_maps(MaterialDraft& draft, const LegacyMaterial& factors, bool as_dielectric);
  ConvertedImages& converted_images(MaterialDraft& draft, const LegacyMaterial& factors, bool as_dielectric,
                                    const MtlMap& data_map);
  void set_extension(MaterialDraft& draft, std::string_view name, Json value);
  void keep_diffuse_map(MaterialDraft& draft);
  double alpha_of(const MtlCover& cover) const;
  bool is_transparent(const MaterialDraft& draft) const;
  void set_opacity(MaterialDraft& draft);
  bool add_opacity(MaterialDraft& draft);
  void set_emission(MaterialDraft& draft);
  void set_normals(MaterialDraft& draft);
  std::shared_ptr<const ImagePixels> packed_metal_rough(MaterialDraft& draft, const MtlMap** model);
  std::size_t base_image_of(MaterialDraft& draft);

  const AssetOptions& options_;
  const AssetResources& resources_;
  const MtlLibraries& libraries_;
  GltfTextures& textures_;
  AssetConversion& conversion_;
  bool reads_tr_ = true;
  std::set<std::string> extensions_;
  std::map<std::string, std::size_t> composed_;  // color images with alpha, keyed by both files
  std::map<std::string, std::shared_ptr<ConvertedImages>> converted_;  // keyed by key_of() and opacity
};

}  // namespace remap
