// Factors of spec-gloss materials without textures as factors of core glTF, by the projection
// (stages/code/projection.inc).
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "assets/document/material_values.hpp"
#include "remap/converter.hpp"
#include "remap/workflow.hpp"

namespace remap {

// Linear, 0 to 1; the defaults are those of KHR_materials_pbrSpecularGlossiness.
struct SpecGlossFactors {
  std::array<double, 3> diffuse = {1.0, 1.0, 1.0};
  std::array<double, 3> specular = {1.0, 1.0, 1.0};
  double glossiness = 1.0;
};

// Linear, 0 to 1.
struct MetalRoughFactors {
  std::array<float, 3> base_color = {1.0f, 1.0f, 1.0f};
  float metallic = 1.0f;
  float roughness = 1.0f;
  float residual = 0.0f;  // what metal-rough cannot represent (Parameter::kResidual)
};

// From gltf-specgloss to gltf, with roughness at both ends.
std::unique_ptr<Converter> specgloss_projection(double prior, InstructionSet set);

// The result of a conversion to gltf, with its diagnosis.
MetalRoughFactors metal_rough_of(const MaterialValues& values);

// 1 - glossiness, rounded once.
float roughness_of(double glossiness);

MetalRoughFactors projected(const SpecGlossFactors& material, const Converter& converter);

// All materials, in their order.
std::vector<MetalRoughFactors> projected(const std::vector<SpecGlossFactors>& materials,
                                         double prior = kCleanPrior,
                                         InstructionSet set = best_instruction_set());

}  // namespace remap
