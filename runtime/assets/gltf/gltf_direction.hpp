// This file declares directions of conversion of glTF materials. A direction reads a material, converts it,
// and returns the new members of its text. The writer (gltf_material_writer.hpp) does not depend on the
// direction.
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

// A TextureText is a texture of a converted material. It is a texture info of the file, either unchanged or
// with the index of a new texture.
struct TextureText {
  SpanValue info;                    // empty without a texture
  std::optional<std::size_t> added;  // result of GltfNewImages::add_texture()

  explicit operator bool() const noexcept { return static_cast<bool>(info); }
};

// A MemberText is a member of an object. Its value is a JSON text or a texture. If it has neither, the member
// is not written.
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

struct MaterialEdit {
  SpanValue material;
  std::vector<MemberText> core;  // members of pbrMetallicRoughness, in their order
  std::vector<std::string_view> removed_extensions;
  std::vector<ExtensionText> added_extensions;
  SpanValue carried_extras;  // extras of a removed extension; they move to pbrMetallicRoughness
  // warning if vertex colors multiply a color that the conversion changes; or empty
  std::string vertex_color_warning;
};

class GltfDirection {
 public:
  virtual ~GltfDirection() = default;
  // Returns true if this direction converts the material.
  virtual bool applies_to(SpanValue material) const = 0;
  // Returns the members of a material that this direction replaces, such as `pbrMetallicRoughness` and
  // `extensions/KHR_materials_ior`.
  virtual std::vector<std::string> replaced() const = 0;
  // Converts a material and fills in the report. Throws kInput with the reason of a failure.
  virtual MaterialEdit convert(SpanValue material, AssetMaterial& report) = 0;
};

// These functions make directions. `options` and `textures` must outlive them. `textures` is null if no
// images can be read.

// Makes the direction from KHR_materials_pbrSpecularGlossiness to core, with or without
// KHR_materials_specular and _ior.
std::unique_ptr<GltfDirection> make_specgloss_to_core(const AssetOptions& options,
                                                      MaterialTextures* textures);
// Makes the direction that adds KHR_materials_pbrSpecularGlossiness to core, with KHR_materials_specular or
// _ior.
std::unique_ptr<GltfDirection> make_core_to_specgloss(const AssetOptions& options,
                                                      MaterialTextures* textures);
// Makes the direction that folds KHR_materials_specular and _ior into core.
std::unique_ptr<GltfDirection> make_specular_fold(const AssetOptions& options, MaterialTextures* textures);

}  // namespace remap
