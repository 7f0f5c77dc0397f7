// Maps of spec-gloss materials as maps of core glTF: the conversion of maps in memory
// (remap/convert_maps.hpp), with what a material of an asset needs around it.
#pragma once

#include <optional>

#include "assets/image_codec.hpp"
#include "assets/specgloss_factors.hpp"

namespace remap {

// Whether every texel equals the first.
bool is_constant(const ImagePixels& pixels);

// The first texel: red, green, blue and alpha from 0 to 1 as stored; grey is repeated, alpha 1 where there is
// none.
std::array<float, 4> first_texel(const ImagePixels& pixels);

// A stored value of sRGB as a linear one.
float linear_of_srgb(float value);

// Maps of one size. Their colors are sRGB, multiplied by the factors.
struct SpecGlossMaps {
  const ImagePixels* diffuse = nullptr;    // null for none
  const ImagePixels* specgloss = nullptr;  // specular, and glossiness as alpha; null for none
  SpecGlossFactors factors;
};

struct MetalRoughMaps {
  // sRGB, with the alpha of diffuse; none where base color is the diffuse map times its factor within 1/255.
  std::optional<ImagePixels> base_color;
  std::optional<ImagePixels> metal_rough;   // as glTF packs them; none where both are constant
  float metallic = 1.0f, roughness = 1.0f;  // factors
  bool has_metal = false;                   // whether metallic is above 0 anywhere
  double residual = 0.0;                    // root of the mean square of Parameter::kResidual, of a sample
};

// At least one map is given.
MetalRoughMaps projected(const SpecGlossMaps& maps, double prior, InstructionSet set);

// Roughness as green, of the glossiness in alpha times its factor.
ImagePixels roughness_map(const ImagePixels& specgloss, double glossiness);

}  // namespace remap
