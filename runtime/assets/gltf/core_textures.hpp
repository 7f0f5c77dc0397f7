// Textured materials in core glTF: which images are converted, once for each distinct set with its factors,
// and how the result is read.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "assets/gltf/core_material.hpp"
#include "assets/gltf/material_textures.hpp"
#include "assets/maps/core_maps.hpp"

namespace remap {

// JSON of a spec-gloss material.
struct SpecGlossTexts {
  std::array<std::string, 4> diffuse;
  std::array<std::string, 3> specular;
  std::string glossiness;
  TextureText diffuse_texture, specgloss_texture;
};

// The textures of a material that vary.
struct CoreUsed {
  std::optional<UsedTexture> base, metal_rough, specular, specular_color;

  CoreMaps maps(const CoreMaterial& material) const;
  std::string key(const CoreMaterial& material) const;
  const UsedTexture& color_model() const;
  const UsedTexture& data_model() const;
};

class CoreTextures {
 public:
  explicit CoreTextures(MaterialTextures& textures) : textures_(textures) {}

  // None where all maps are constant: they are then factors of `material`. Throws kInput for maps that cannot
  // be read or do not lie on one grid. `converter`: make_core_converter() for the material.
  std::optional<SpecGlossTexts> specgloss(CoreMaterial& material, const Converter& converter,
                                          std::vector<std::string>& warnings);
  std::optional<CoreTexts> folded(CoreMaterial& material, const Converter& converter,
                                  std::vector<std::string>& warnings);

 private:
  // What became of a set of images, with the numbers of new ones; the pixels are gone.
  struct ToSpecGloss {
    SpecGlossImages images;
    std::optional<std::size_t> diffuse_image, specgloss_image;
  };
  struct ToCore {
    MetalRoughMaps maps;
    std::optional<std::size_t> base_image, metal_rough_image;
  };

  CoreUsed load(CoreMaterial& material, bool needs_base, const GridReason& reason,
                std::vector<std::string>& warnings) const;

  MaterialTextures& textures_;
  std::map<std::string, ToSpecGloss> to_specgloss_;  // by images and factors
  std::map<std::string, ToCore> to_core_;
};

}  // namespace remap
