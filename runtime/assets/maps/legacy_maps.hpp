// This file converts materials from before microfacets (Wavefront MTL, OpenGL, Collada) to GGX materials, as
// numbers or texel by texel. It uses two formulas with five constants, chosen by pictures under lights and
// environments (docs/decisions/060-short-forms.md). The exponent decides the width of the highlight. It also
// decides its strength, because an unnormalised lobe has energy proportional to 1 / exponent.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>

#include "assets/document/asset.hpp"
#include "assets/maps/gltf_maps.hpp"
#include "remap/convert_maps.hpp"

namespace remap {

// A LegacyMaterial has radiance = diffuse N.L + specular (N.H)^exponent, without a cosine or a norm on the
// lobe. This is unnormalised Blinn, illum 2 in the MTL specification (Alias|Wavefront 1995). Colors are
// linear, 0 to 1.
struct LegacyMaterial {
  std::array<double, 3> diffuse{}, specular{};
  double exponent = kLeastExponent;

  bool has_highlight() const noexcept {
    return std::ranges::any_of(specular, [](double value) { return value > 0.0; });
  }

  // The constants were measured for this range. The specification allows 0 to 1000.
  static constexpr double kLeastExponent = 1.0, kMostExponent = 10000.0;
};

// Return the lobe of the material as GGX: glTF's roughness (1.55 / (n + 4.17))^(1/4), and F0 = min(1, 6.02
// specular / (n + 1.86)), which does not change with the angle.
double ggx_roughness(const LegacyMaterial& material);
std::array<double, 3> ggx_f0(const LegacyMaterial& material);

// Returns base color and metallic of core glTF that keep the sum of diffuse and specular:
//   fraction of the dielectric f = min(1, 2 D / (S + D + sqrt((S + D)^2 - .16 D))), base = d + F0 - .04 f.
// D and S are the means of diffuse and F0 over channels, and .04 is the F0 of a dielectric. A material
// without a highlight gets base color = diffuse and roughness 1. Core cannot remove the F0 of .04. At
// roughness 1 this F0 adds about as much light as the diffuse lobe loses, so bright colors stay.
MetalRoughFactors core_of_legacy(const LegacyMaterial& material);

// A LegacyDielectric is glTF with KHR_materials_specular: metallic 0, and a specular whose F90 equals the
// largest F0, because the source has no Fresnel effect.
struct LegacyDielectric {
  std::array<double, 3> base_color{};  // min(1, diffuse / (1 - specular)), 0 to 1
  double specular = 0.0;               // specularFactor: the largest F0, 0 to 1
  // F0 / specular, 0 to 1. specularColorFactor is kDielectricScale * specular_color.
  std::array<double, 3> specular_color{};
  double roughness = 1.0;
};
inline constexpr double kDielectricScale = 25.0;  // 1 / .04

LegacyDielectric dielectric_of_legacy(const LegacyMaterial& material);

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
