// This file converts materials of any workflow to core glTF. Materials with equal images and factors share
// the result.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "assets/gltf/gltf_direction.hpp"
#include "assets/gltf/gltf_workflow.hpp"

namespace remap {

// A CoreTexts holds the JSON texts of a material in core glTF, and with --extensions write also of
// KHR_materials_specular.
struct CoreTexts {
  std::array<std::string, 4> base_color;
  std::string metallic, roughness;
  TextureText base_texture, metal_rough_texture;
  TextureText specular_texture;
  bool has_metal = false;  // true if metallic is above 0 anywhere
  double residual = 0.0;   // Parameter::kResidual; for maps the root of its mean square
};

// Returns all members of pbrMetallicRoughness.
std::vector<MemberText> core_members(const CoreTexts& texts);
// Describes a material: `base color map times 1 1 1, metallic 0, roughness 1`. `kept` is the word for a map
// that does not change.
std::string core_summary(const CoreTexts& texts, const std::string& kept);

class CoreMaker {
 public:
  // `textures` must outlive this object.
  CoreMaker(const AssetOptions& options, MaterialTextures* textures, GltfWorkflow workflow, GridReason reason)
      : textures_(textures),
        workflow_(workflow),
        reason_(reason),
        converter_(converter_of(workflow, "gltf", options)) {}

  // Converts a material. Constant maps become factors of `material`. Throws kInput for maps that cannot be
  // read or do not lie on one grid.
  CoreTexts convert(GltfMaterial& material, AssetMaterial& report);

 private:
  // A Made is the result for a set of images. It has the indices of the new images, but not their pixels.
  struct Made {
    MetalRoughMaps maps;
    std::optional<std::size_t> base_image, metal_rough_image;
  };

  CoreTexts of_factors(const GltfMaterial& material, AssetMaterial& report) const;
  CoreTexts of_maps(const GltfMaterial& material, const UsedTextures& used);

  MaterialTextures* textures_;  // null if no images can be read
  GltfWorkflow workflow_;
  GridReason reason_;
  std::unique_ptr<Converter> converter_;
  std::map<std::string, Made> made_;  // keyed by GltfMaps::key
};

}  // namespace remap
