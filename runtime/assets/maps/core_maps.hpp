// Converts maps of core glTF, with KHR_materials_specular and _ior, to maps of spec-gloss materials, or of
// core without these extensions.
#pragma once

#include <array>
#include <optional>

#include "assets/document/image_codec.hpp"
#include "assets/maps/core_factors.hpp"
#include "assets/maps/metal_rough_maps.hpp"
#include "remap/converter.hpp"

namespace remap {

// Maps of one size, with their factors. Null for none.
struct CoreMaps {
  const ImagePixels* base = nullptr;            // sRGB
  const ImagePixels* metal_rough = nullptr;     // roughness as green, metallic as blue
  const ImagePixels* specular = nullptr;        // alpha
  const ImagePixels* specular_color = nullptr;  // sRGB
  CoreFactors factors;
  bool has_dielectric = false;  // as of the converter (make_core_converter())

  // The material at the first texel, without alpha.
  CoreFactors first() const;
};

// At least one map is given, here and below.
MetalRoughMaps folded(const CoreMaps& maps, const Converter& converter);

struct SpecGlossImages {
  // sRGB, with the alpha of the base map. None where diffuse is a factor, or the base map times one.
  std::optional<ImagePixels> diffuse;
  bool keeps_base = false;  // diffuse is the base map times `diffuse_factors`
  float alpha = 1.0f;       // of a base map that a factor replaces
  std::array<float, 3> diffuse_factors = {1.0f, 1.0f, 1.0f};
  std::optional<ImagePixels> specgloss;  // specular in sRGB, glossiness as alpha; none where both are factors
  std::array<float, 3> specular = {1.0f, 1.0f, 1.0f};
  float glossiness = 1.0f;
};

SpecGlossImages specgloss_images(const CoreMaps& maps, const Converter& converter);

}  // namespace remap
