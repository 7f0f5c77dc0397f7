// Maps of legacy materials as maps of glTF, texel by texel (legacy_material.hpp).
#pragma once

#include <array>
#include <optional>

#include "assets/document/image_codec.hpp"
#include "assets/maps/legacy_material.hpp"

namespace remap {

// Maps of one size, at least one of which is given. Colors are sRGB; the exponent is a value from 0 to 1. The
// factors multiply them.
struct LegacyMaps {
  const ImagePixels* diffuse = nullptr;
  const ImagePixels* specular = nullptr;
  const ImagePixels* exponent = nullptr;
  char exponent_channel = 'l';  // r, g, b, m for alpha, l for luminance
  LegacyMaterial factors;
  bool as_dielectric = false;  // with KHR_materials_specular
};

struct LegacyMapResult {
  std::optional<ImagePixels> base_color;  // sRGB; none where `base` alone says it, or times the diffuse map
  bool keeps_diffuse = false;             // base color is the diffuse map times `base`, within 1/255
  std::array<double, 3> base = {1.0, 1.0, 1.0};
  std::optional<ImagePixels> metal_rough;  // as glTF packs them; none where both are constant
  double metallic = 1.0, roughness = 1.0;  // factors
  std::optional<ImagePixels> specular;     // of a dielectric: F0 / F in sRGB, F / `specular_factor` as alpha
  double specular_factor = 0.0;            // of a dielectric: F, or what alpha is a share of
  std::array<double, 3> specular_color = {1.0, 1.0, 1.0};  // of a dielectric: F0 / F, or 1 with a map
};

LegacyMapResult converted_maps(const LegacyMaps& maps);

// One channel of an image as an image of grey.
ImagePixels channel_of(const ImagePixels& pixels, std::size_t channel);

// An image of three channels, or four with opacity: the colors of `color`, or white, and as alpha a channel
// of `opacity` (load_scalar_row()). One of them may be null; both have one size.
ImagePixels with_alpha(const ImagePixels* color, const ImagePixels* opacity, char channel);

// The values of a map moved to base + gain x within 0 to 1, as -mm has it: "base adds a base value to the
// texture values", "gain expands the range of the texture values" (Alias|Wavefront, MTL 4.2, 1995). Values
// are those that the file stores. Alpha moves where `with_alpha`.
ImagePixels with_levels(const ImagePixels& pixels, double base, double gain, bool with_alpha);

// Replaces a channel by one of a map of the same size (load_scalar_row()).
void set_channel(ImagePixels& pixels, std::size_t channel, const ImagePixels& from, char from_channel);

// The channel of a map that holds one value, as MTL selects it (-imfchan), from 0 to 1: `count` values of row
// `y`.
void load_scalar_row(const ImagePixels& pixels, char channel, std::size_t y, float* values);

}  // namespace remap
