// A direction of conversion of glTF materials: it reads a material, converts it, and says which members its
// text gets. What writes them (gltf_material_writer.hpp) knows no direction.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assets/document/asset.hpp"
#include "core/json_spans.hpp"

namespace remap {

class MaterialTextures;

// A texture of a converted material: an info of the file as it stands, or with the index of a new texture.
struct TextureText {
  SpanValue info;                    // none for no texture
  std::optional<std::size_t> added;  // of GltfNewImages::add_texture()

  explicit operator bool() const noexcept { return static_cast<bool>(info); }
};

// A member of an object: a text of JSON or a texture. With neither it is absent.
struct MemberText {
  std::string_view name;
  std::string text;
  TextureText texture;

  bool is_absent() const noexcept { return text.empty() && !texture; }
};

struct ExtensionText {
  std::string_view name;
  std::vector<MemberText> members;
};

// The edits of the text of a material.
struct MaterialEdit {
  SpanValue material;
  std::vector<MemberText> core;  // of pbrMetallicRoughness, in their order
  std::vector<std::string_view> removed_extensions;
  std::vector<ExtensionText> added_extensions;
  SpanValue carried_extras;          // of a removed extension, which pbrMetallicRoughness takes
  std::string vertex_color_warning;  // what changes if vertex colors multiply a color; empty for nothing
};

class GltfDirection {
 public:
  virtual ~GltfDirection() = default;
  // Whether it converts the material.
  virtual bool applies_to(SpanValue material) const = 0;
  // Members of a material whose values it replaces: `pbrMetallicRoughness`, `extensions/KHR_materials_ior`.
  virtual std::vector<std::string> replaced() const = 0;
  // Fills in what a report says of a converted material. Throws kInput with the reason of a failure.
  virtual MaterialEdit convert(SpanValue material, AssetMaterial& report) = 0;
};

// The inputs of a direction besides materials; both must outlive it.
struct DirectionParts {
  const AssetOptions& options;
  MaterialTextures* textures;  // null where no images can be read
};

// KHR_materials_pbrSpecularGlossiness to core, or to core with KHR_materials_specular and _ior.
std::unique_ptr<GltfDirection> make_specgloss_to_core(const DirectionParts& parts);
// Core, with KHR_materials_specular and _ior, to KHR_materials_pbrSpecularGlossiness beside it.
std::unique_ptr<GltfDirection> make_core_to_specgloss(const DirectionParts& parts);
// KHR_materials_specular and _ior into core.
std::unique_ptr<GltfDirection> make_specular_fold(const DirectionParts& parts);

}  // namespace remap
