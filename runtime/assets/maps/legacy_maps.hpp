// This file converts maps of legacy materials to maps of glTF, texel by texel (legacy_material.hpp).
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>

#include "assets/document/image_codec.hpp"
#include "assets/maps/legacy_material.hpp"
#include "remap/convert_maps.hpp"

namespace remap {

// A LegacyMaps holds maps of one size, at least one of which is given. Colors are sRGB. The exponent is a
// value from 0 to 1. The factors multiply the maps.
struct LegacyMaps {
  std::shared_ptr<const ImagePixels> diffuse, specular, exponent;  // null if missing
  char exponent_channel = 'l';                                     // r, g, b, m for alpha, l for luminance
  LegacyMaterial factors;
  bool as_dielectric = false;  // with KHR_materials_specular
};

struct LegacyMapResult {
  MetalRoughFactors factors;  // the base color is 1 if there is a map of it
  // This map is sRGB. It is unset if base color is only a factor, or the diffuse map times a factor.
  std::optional<ImagePixels> base_color;
  bool keeps_diffuse = false;  // true if base color is the diffuse map times its factor, within 1/255
  std::optional<ImagePixels> metal_rough;  // packed as in glTF; unset if both are constant
  // This map is set only for a dielectric. Its color is F0 / F in sRGB, and its alpha is F /
  // `specular_factor`.
  std::optional<ImagePixels> specular;
  // This is set only for a dielectric. It is F. If there is a map, it is the largest F, and alpha is a
  // fraction of it.
  double specular_factor = 0.0;
  std::array<double, 3> specular_color = {1.0, 1.0, 1.0};  // for a dielectric: F0 / F; 1 if there is a map
};

LegacyMapResult converted_maps(const LegacyMaps& maps);

// Returns diffuse, specular and the exponent, with their factors, as sources of a conversion. `exponents`
// receives the exponents of a map, and must outlive the result.
std::map<Parameter, SourceParameter> sources_of(const LegacyMaps& maps, ImagePixels& exponents);

ImagePixels channel_of(const ImagePixels& pixels, std::size_t channel);

// Returns an image of three channels, or four with opacity. Colors come from `color`, and are white if it is
// null. Alpha comes from a channel of `opacity` (load_scalar_row()). One of the two may be null. Both have
// the same size.
ImagePixels with_alpha(const ImagePixels* color, const ImagePixels* opacity, char channel);

// Returns a map with values base + gain x, clamped to 0 to 1, for the option -mm of MTL. The specification
// states: "base adds a base value to the texture values", "gain expands the range of the texture values"
// (Alias|Wavefront, MTL 4.2, 1995). x is the stored value. Alpha changes only if `with_alpha`.
ImagePixels with_levels(const ImagePixels& pixels, double base, double gain, bool with_alpha);

// Replaces a channel by the values that load_scalar_row() loads from another map of the same size.
void set_channel(ImagePixels& pixels, std::size_t channel, const ImagePixels& from, char from_channel);

// Loads the values of row `y`, from 0 to 1. They come from the channel that MTL gives for maps of one
// value (-imfchan).
void load_scalar_row(const ImagePixels& pixels, char channel, std::size_t y, float* values);

// Returns the values of load_scalar_row() as a map of floats with one channel.
ImagePixels scalar_map(const ImagePixels& pixels, char channel);

}  // namespace remap
