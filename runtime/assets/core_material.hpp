// A material in core glTF, with KHR_materials_specular and _ior: as a file describes it, and as its text will
// describe it.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "assets/gltf_direction.hpp"
#include "assets/gltf_factors.hpp"
#include "assets/json_spans.hpp"
#include "assets/material_values.hpp"
#include "remap/converter.hpp"
#include "remap/workflow.hpp"

namespace remap {

// Linear. F0 of a dielectric is that of the index times the color, 1 at most, times `specular`.
struct CoreFactors {
  std::array<double, 3> base_color = {1.0, 1.0, 1.0};
  double metallic = 1.0, roughness = 1.0;
  double f0_of_index = kCommonDielectricF0;
  double specular = 1.0;
  std::array<double, 3> specular_color = {1.0, 1.0, 1.0};

  std::array<double, 3> f0() const;
};

// ((ior - 1) / (ior + 1))^2; of 0, which stands for a very large index, 1 (KHR_materials_ior).
double f0_of_index(double ior);

struct CoreMaterial {
  SpanValue material;
  std::array<FactorText, 4> base_color;
  FactorText metallic, roughness;
  FactorText ior = {1.5, "1.5"}, specular;
  std::array<FactorText, 3> specular_color;
  // None for none.
  SpanValue base_texture, metal_rough_texture, specular_texture, specular_color_texture;
  bool has_dielectric = false;  // an extension that says its F0

  CoreFactors factors() const;
};

// Throws kInput for factors that cannot be read, and for an index between 0 and 1.
CoreMaterial read_core_material(SpanValue material, std::vector<std::string>& warnings);

// The values that a converter of make_core_converter() takes.
MaterialValues values_of(const CoreFactors& factors, bool has_dielectric);

// From core to a workflow model, with roughness at both ends; with dielectrics of any F0, which are kSpecular
// of its source.
std::unique_ptr<Converter> make_core_converter(const char* target, bool has_dielectric, double prior,
                                               InstructionSet set);

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
