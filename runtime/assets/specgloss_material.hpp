// A spec-gloss material as a glTF file describes it, and as its text will describe it in core glTF.
#pragma once

#include <array>
#include <string>

#include "assets/json_spans.hpp"
#include "assets/specgloss_factors.hpp"
#include "core/number_text.hpp"

namespace remap {

// A factor from 0 to 1, as the file writes it or as it is clamped.
struct FactorText {
  double value = 1.0;
  std::string text = "1";
};

struct SpecGlossMaterial {
  SpanValue material, extension;  // its object, and the object of spec-gloss
  std::array<FactorText, 4> diffuse;
  std::array<FactorText, 3> specular;
  FactorText glossiness;
  SpanValue diffuse_texture, specgloss_texture;  // none for none
  bool is_unlit = false;

  SpecGlossFactors factors() const {
    return {{diffuse[0].value, diffuse[1].value, diffuse[2].value},
            {specular[0].value, specular[1].value, specular[2].value},
            glossiness.value};
  }
};

// JSON of a material in core glTF, with KHR_materials_specular in the exact form. Textures are texture infos;
// empty for none.
struct CoreTexts {
  std::array<std::string, 4> base_color;
  std::string metallic, roughness;
  std::string base_texture, metal_rough_texture;
  std::string specular_texture;
  bool has_metal = false;  // whether metallic is above 0 anywhere
  double residual = 0.0;   // Parameter::kResidual; of maps the root of its mean square
};

// The shortest text that reads back as the float.
inline std::string float_text(float value) { return number_text(decimal_value(value)); }

}  // namespace remap
