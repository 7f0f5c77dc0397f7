// Materials of MTL files as materials of a new glTF file, with their textures.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "assets/asset.hpp"
#include "assets/mtl_document.hpp"
#include "assets/mtl_images.hpp"
#include "assets/mtl_material.hpp"
#include "assets/obj_buffer.hpp"
#include "assets/obj_mesh.hpp"

namespace remap {

// Lists of the file, each of which may be empty.
struct GltfMaterialLists {
  Json materials = Json::list(), textures = Json::list(), images = Json::list(), samplers = Json::list();
  std::set<std::string> extensions;
  std::vector<bool> has_texture;  // of each material
};

class ObjMaterials {
 public:
  // Where images go.
  enum class ImagePlace {
    kBuffer,  // into the buffer
    kFiles,   // files that are there stay where they are, new ones lie beside them
  };

  // All must outlive it. Materials, warnings, new files and resources are added to `conversion`.
  ObjMaterials(const AssetOptions& options, const AssetResources& resources, ImagePlace place,
               GltfBuffer& buffer, AssetConversion& conversion);
  ~ObjMaterials();

  // Reads the MTL files that lines `mtllib` name. One that is missing is a warning. Throws kInput for one
  // that cannot be read.
  void read_libraries(const std::vector<std::string>& lines);
  // Materials of an OBJ file in their order. One that no file has counts as white.
  GltfMaterialLists converted(const std::vector<ObjMaterialName>& names);

 private:
  struct Library;
  struct Planned;
  struct ConvertedImages;

  bool read_library(const std::string& name);
  bool is_tr_opacity() const;
  double alpha_of(const MtlCover& cover) const;
  bool is_transparent(const Planned& planned) const;
  Json material_of(const ObjMaterialName& name, AssetMaterial& report);
  Json converted_block(Library& library, const MtlBlock& block, AssetMaterial& report);
  void set_reflection(Planned& planned);
  void set_metal_rough(Planned& planned);
  void set_core(Planned& planned, const MtlReflection& reflection);
  void set_dielectric(Planned& planned, const MtlReflection& reflection);
  void set_converted_maps(Planned& planned, const MtlReflection& reflection, bool as_dielectric);
  void keep_diffuse_map(Planned& planned);
  void set_opacity(Planned& planned);
  void set_emission(Planned& planned);
  void set_normals(Planned& planned);
  std::shared_ptr<const ImagePixels> packed_metal_rough(Planned& planned, const MtlMap** model);

  std::size_t base_image_of(Planned& planned);
  std::size_t add_file_image(Library& library, const MtlMap& map, std::vector<std::string>& warnings);
  std::size_t add_new_image(Library& library, const ImagePixels& pixels, const MtlMap& model,
                            std::string_view suffix);
  std::size_t add_image_bytes(std::string_view bytes, const char* type, const std::string& name);
  Json texture_info(std::size_t image, const MtlMap& map);

  const AssetOptions& options_;
  const AssetResources& resources_;
  ImagePlace place_;
  GltfBuffer& buffer_;
  AssetConversion& conversion_;
  std::vector<std::unique_ptr<Library>> libraries_;
  std::set<std::string> library_paths_;
  std::map<std::string, std::pair<Library*, std::size_t>> blocks_;  // the first of each name
  GltfMaterialLists lists_;
  NewImageNames names_;
  bool reads_tr_ = true;
  std::size_t texture_uses_ = 0;
  std::map<std::string, std::size_t> file_images_;                     // by path
  std::map<std::pair<std::size_t, bool>, std::size_t> textures_;       // by image and whether it clamps
  std::map<std::string, std::size_t> composed_;                        // color with alpha, by both files
  std::map<std::string, std::shared_ptr<ConvertedImages>> converted_;  // by key_of() and opacity
};

// A path as a URI: other characters than letters, digits and `-._~/` are bytes with percent signs.
std::string uri_of_path(const std::string& path);

// A text that JSON can hold: one that is not UTF-8 is read as Latin-1.
std::string utf8_name(const std::string& text);

}  // namespace remap
