// Maps of spec-gloss materials as maps of core glTF.
#pragma once

#include "assets/document/image_codec.hpp"
#include "assets/maps/metal_rough_maps.hpp"
#include "assets/maps/specgloss_factors.hpp"

namespace remap {

// Maps of one size. Their colors are sRGB, multiplied by the factors.
struct SpecGlossMaps {
  const ImagePixels* diffuse = nullptr;    // null for none
  const ImagePixels* specgloss = nullptr;  // specular, and glossiness as alpha; null for none
  SpecGlossFactors factors;
};

// At least one map is given. `projection`: specgloss_projection().
MetalRoughMaps projected(const SpecGlossMaps& maps, const Converter& projection);

// Roughness as green, of the glossiness in alpha times its factor.
ImagePixels roughness_map(const ImagePixels& specgloss, double glossiness);

}  // namespace remap
