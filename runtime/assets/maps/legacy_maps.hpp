// This file converts maps of legacy materials to maps of glTF, texel by texel (legacy_material.hpp).
#pragma once

#include <array>
#include <optional>

#include "assets/document/image_codec.hpp"
#include "assets/maps/legacy_material.hpp"

namespace remap {

// A LegacyMaps holds maps of one size, at least one of which is given. Colors are sRGB; the exponent is a
// value from 0 to 1. The factors multiply them.
struct LegacyMaps {
  const ImagePixels* diffuse = nullptr;
  const ImagePixels* specular = nullptr;
  const ImagePixels* exponent = nullptr;
  char exponent_channel = 'l';  // r, g, b, m for alpha, l for luminance
  LegacyMaterial factors;
  bool as_dielectric = false;  // with KHR_materials_specular
};

struct LegacyMapResult {
  std::optional<ImagePixels> base_color;  // sRGB; none if `base` suffices, or the diffuse map times it
  bool keeps_diffuse = false;             // base color is the diffuse map times `base`, within 1/255
  std::array<double, 3> base = {1.0, 1.0, 1.0};
  std::optional<ImagePixels> metal_rough;  // as glTF packs them; none if both are constant
  double metallic = 1.0, roughness = 1.0;  // factors
  std::optional<ImagePixels> specular;     // of a dielectric: F0 / F in sRGB, F / `specular_factor` as alpha
  double specular_factor = 0.0;            // of a dielectric: F, or the F that alpha is a fraction of
  std::array<double, 3> specular_color = {1.0, 1.0, 1.0};  // of a dielectric: F0 / F, or 1 with a map
};

LegacyMapResult converted_maps(const LegacyMaps& maps);

ImagePixels channel_of(const ImagePixels& pixels, std::size_t channel);

// Returns an image of three channels, or four with opacity: the colors of `color`, or white, and as alpha a
// channel of `opacity` (load_scalar_row()). One of them may be null. Both have the same size.
ImagePixels with_alpha(const ImagePixels* color, const ImagePixels* opacity, char channel);

// Returns a map with values base + gain x, clamped to 0 to 1, as -mm describes: "base adds a base value to
// the texture values", "gain expands the range of the texture values" (Alias|Wavefront, MTL 4.2, 1995). The
// values are the stored ones. Alpha changes only if `with_alpha`.
ImagePixels with_levels(const ImagePixels& pixels, double base, double gain, bool with_alpha);

// Replaces a channel by the values that load_scalar_row() loads from another map of the same size.
void set_channel(ImagePixels& pixels, std::size_t channel, const ImagePixels& from, char from_channel);

// Loads `count` values of row `y`, from 0 to 1. They come from MTL's channel for scalar maps (-imfchan).
void load_scalar_row(const ImagePixels& pixels, char channel, std::size_t y, float* values);

}  // namespace remap
