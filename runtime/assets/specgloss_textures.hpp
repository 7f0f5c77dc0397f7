// Textured spec-gloss materials: which images are converted, once for each distinct pair with its factors,
// and how the result is read.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "assets/gltf_images.hpp"
#include "assets/specgloss_maps.hpp"
#include "assets/specgloss_material.hpp"

namespace remap {

class SpecGlossTextures {
 public:
  // `images` must outlive it.
  // `enlarges`: smaller images of a pair are enlarged, else such a pair fails.
  SpecGlossTextures(GltfImages& images, double prior, InstructionSet set, bool enlarges)
      : images_(images), prior_(prior), set_(set), enlarges_(enlarges) {}

  // By the projection. None where all maps are constant: they are then factors of `material`. Throws kInput
  // for maps that cannot be read or do not lie on one grid.
  std::optional<CoreTexts> core(SpecGlossMaterial& material, std::vector<std::string>& warnings);
  // The exact form, of which only roughness needs a new image.
  CoreTexts exact(const SpecGlossMaterial& material);

 private:
  // A texture of a material that varies.
  struct Used {
    TextureInfo info;
    AssetImage image;
  };
  // What became of a pair of images.
  struct Converted {
    std::optional<std::size_t> base_image, metal_rough_image;
    float metallic = 1.0f, roughness = 1.0f;
    bool has_metal = false;
    double residual = 0.0;
  };

  std::optional<Used> load(SpanValue texture_info);
  void require_one_grid(const Used& diffuse, const Used& specgloss, std::vector<std::string>& warnings) const;
  // Gives both the larger size.
  void enlarge(Used& diffuse, Used& specgloss) const;
  const Converted& converted(const std::optional<Used>& diffuse, const std::optional<Used>& specgloss,
                             const SpecGlossMaterial& material);
  std::string new_info(const Used& model, std::size_t image);

  GltfImages& images_;
  double prior_;
  InstructionSet set_;
  bool enlarges_;
  std::map<std::string, Converted> converted_;         // by images and factors
  std::map<std::string, std::size_t> roughness_maps_;  // by image and factor
};

}  // namespace remap
