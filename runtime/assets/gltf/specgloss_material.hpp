// A spec-gloss material as a glTF file describes it.
#pragma once

#include <array>

#include "assets/gltf/gltf_factors.hpp"
#include "assets/maps/specgloss_factors.hpp"
#include "core/json_spans.hpp"

namespace remap {

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

}  // namespace remap
