// Maps of core glTF, made by any conversion to it.
#pragma once

#include <array>
#include <optional>

#include "assets/document/image_codec.hpp"
#include "remap/convert_maps.hpp"
#include "remap/converter.hpp"

namespace remap {

struct MetalRoughMaps {
  // sRGB, with the alpha of the map of color; none where base color is that map times its factor within
  // 1/255.
  std::optional<ImagePixels> base_color;
  std::optional<ImagePixels> metal_rough;   // as glTF packs them; none where both are constant
  float metallic = 1.0f, roughness = 1.0f;  // factors
  bool has_metal = false;                   // whether metallic is above 0 anywhere
  double residual = 0.0;                    // root of the mean square of Parameter::kResidual, of a sample
};

// The maps that a conversion comes from, of one size.
struct MetalRoughSources {
  MapConversion conversion;            // with its sources and conventions
  const ImagePixels* color = nullptr;  // diffuse or base color, in sRGB; null for none
  std::array<double, 3> color_factors = {1.0, 1.0, 1.0};
  const ImagePixels* color_model = nullptr;  // size and type of the results
  const ImagePixels* data_model = nullptr;
};

MetalRoughMaps metal_rough_maps(const Converter& converter, MetalRoughSources sources);

}  // namespace remap
