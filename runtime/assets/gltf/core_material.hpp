// A material in core glTF, with KHR_materials_specular and _ior: as a file describes it, and as its text will
// describe it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "assets/gltf/gltf_direction.hpp"
#include "assets/gltf/gltf_factors.hpp"
#include "assets/maps/core_factors.hpp"
#include "core/json_spans.hpp"

namespace remap {

struct CoreMaterial {
  SpanValue material;
  std::array<FactorText, 4> base_color;
  FactorText metallic, roughness;
  FactorText ior = {1.5, "1.5"}, specular;
  std::array<FactorText, 3> specular_color;
  // Absent if the material has no such texture.
  SpanValue base_texture, metal_rough_texture, specular_texture, specular_color_texture;
  bool has_dielectric = false;  // an extension that says its F0

  CoreFactors factors() const;
};

// Throws kInput for factors that cannot be read, and for an index between 0 and 1.
CoreMaterial read_core_material(SpanValue material, std::vector<std::string>& warnings);

// JSON of a material in core glTF, with KHR_materials_specular in the exact form.
struct CoreTexts {
  std::array<std::string, 4> base_color;
  std::string metallic, roughness;
  TextureText base_texture, metal_rough_texture;
  TextureText specular_texture;
  bool has_metal = false;  // whether metallic is above 0 anywhere
  double residual = 0.0;   // Parameter::kResidual; of maps the root of its mean square
};

// All members of pbrMetallicRoughness.
std::vector<MemberText> core_members(const CoreTexts& texts);
// `base color map times 1 1 1, metallic 0, roughness 1`. `kept`: what it calls the map that it keeps.
std::string core_summary(const CoreTexts& texts, const std::string& kept);

}  // namespace remap
