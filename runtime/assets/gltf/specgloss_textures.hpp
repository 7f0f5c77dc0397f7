// Textured spec-gloss materials: which images are converted, once for each distinct pair with its factors,
// and how the result is read.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "assets/gltf/core_material.hpp"
#include "assets/gltf/material_textures.hpp"
#include "assets/gltf/specgloss_material.hpp"
#include "assets/maps/specgloss_maps.hpp"

namespace remap {

class SpecGlossTextures {
 public:
  // Both must outlive it. `projection`: specgloss_projection().
  SpecGlossTextures(MaterialTextures& textures, const Converter& projection)
      : textures_(textures), projection_(projection) {}

  // By the projection. None where all maps are constant: they are then factors of `material`. Throws kInput
  // for maps that cannot be read or do not lie on one grid.
  std::optional<CoreTexts> core(SpecGlossMaterial& material, std::vector<std::string>& warnings);
  // The exact form, of which only roughness needs a new image.
  CoreTexts exact(const SpecGlossMaterial& material);

 private:
  // The result of a pair of images.
  struct Converted {
    std::optional<std::size_t> base_image, metal_rough_image;  // numbers of new images
    MetalRoughMaps maps;                                       // without their pixels
  };

  const Converted& converted(const std::optional<UsedTexture>& diffuse,
                             const std::optional<UsedTexture>& specgloss, const SpecGlossMaterial& material);

  MaterialTextures& textures_;
  const Converter& projection_;
  std::map<std::string, Converted> converted_;         // by images and factors
  std::map<std::string, std::size_t> roughness_maps_;  // by image and factor
};

}  // namespace remap
