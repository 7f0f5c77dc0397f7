// This file makes maps and factors of glTF materials from those of another workflow.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "assets/document/asset.hpp"
#include "remap/convert_maps.hpp"
#include "remap/converter.hpp"
#include "remap/workflow.hpp"

namespace remap {

using MaterialValues = std::map<Parameter, std::vector<float>>;  // one value, or red, green and blue

// Converts all sources of the converter to all its targets, in the same way as texels of maps.
MaterialValues converted(const Converter& converter, const MaterialValues& material);

// Makes a converter between workflow models (`gltf`, `gltf-specgloss`), with roughness at both ends. With
// `has_dielectric` the source reads the F0 of its dielectrics as kSpecular.
std::unique_ptr<Converter> asset_converter(const char* source, const char* target, double prior,
                                           InstructionSet set, bool has_dielectric = false);

// A MetalRoughFactors has linear values, 0 to 1.
struct MetalRoughFactors {
  std::array<double, 3> base_color = {1.0, 1.0, 1.0};
  double metallic = 1.0;
  double roughness = 1.0;
};

// Returns 1 - glossiness, rounded once.
float roughness_of(double glossiness);

// Returns ((ior - 1) / (ior + 1))^2. An ior of 0 means a very large index, so it gives 1 (KHR_materials_ior).
double f0_of_index(double ior);

// A MapSources holds the maps of a conversion, all of one size. At least one is given.
struct MapSources {
  MapConversion conversion;            // its sources and their roughness encoding must be set
  const ImagePixels* color = nullptr;  // diffuse or base color, in sRGB; may be null
  std::array<double, 3> color_factors = {1.0, 1.0, 1.0};
  const ImagePixels* color_model = nullptr;  // image whose size and pixel type the results have
  const ImagePixels* data_model = nullptr;
};

// A MetalRoughMaps holds maps of core glTF.
struct MetalRoughMaps {
  // This map is sRGB, with the alpha of the color map. It is unset if the color map times the factor equals
  // base color within 1/255.
  std::optional<ImagePixels> base_color;
  std::optional<ImagePixels> metal_rough;   // packed as in glTF; unset if both are constant
  float metallic = 1.0f, roughness = 1.0f;  // factors
  bool has_metal = false;                   // true if metallic is above 0 anywhere
  double residual = 0.0;  // root mean square of Parameter::kResidual, over a sample of texels
};

MetalRoughMaps metal_rough_maps(const Converter& converter, MapSources sources);

// A SpecGlossMaps holds maps of KHR_materials_pbrSpecularGlossiness.
struct SpecGlossMaps {
  // This map is sRGB, with the alpha of the color map. It is unset if diffuse is a factor, or if it is the
  // color map times a factor.
  std::optional<ImagePixels> diffuse;
  bool keeps_color = false;  // diffuse is the color map times `diffuse_factors`
  float alpha = 1.0f;        // alpha of a color map that became a factor
  std::array<float, 3> diffuse_factors = {1.0f, 1.0f, 1.0f};
  // This map has specular in sRGB, and glossiness as alpha. It is unset if both are factors.
  std::optional<ImagePixels> specgloss;
  std::array<float, 3> specular = {1.0f, 1.0f, 1.0f};
  float glossiness = 1.0f;
};

// `first` is the conversion of the first texel. Results that are constant get their factors from it.
SpecGlossMaps specgloss_maps(const Converter& converter, MapSources sources, const MaterialValues& first);

// Returns a map with roughness in green. It is made from the glossiness in alpha times its factor.
ImagePixels roughness_map(const ImagePixels& specgloss, double glossiness);

// Returns the F0 of dielectrics (KHR_materials_specular, _ior): min(1, `most` * color) * factor * alpha of
// `specular`. `most` is the F0 of the index times the color factor. `color` is sRGB. One of the two maps may
// be null. The result has three channels of linear floats, because no converter can limit a product of two
// maps.
ImagePixels f0_map(const ImagePixels* specular, double specular_factor, const ImagePixels* color,
                   const std::array<double, 3>& most);

}  // namespace remap
