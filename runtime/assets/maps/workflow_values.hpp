// Materials of assets without maps: their converters, and the results as factors of core glTF.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <vector>

#include "remap/converter.hpp"
#include "remap/workflow.hpp"

namespace remap {

using MaterialValues = std::map<Parameter, std::vector<float>>;  // one value, or red, green and blue

// All targets of the converter, of all its sources, as the texels of maps are converted.
MaterialValues converted(const Converter& converter, const MaterialValues& material);

// Between workflow models (`gltf`, `gltf-specgloss`), with roughness at both ends. With `has_dielectric` the
// source takes the F0 of its dielectrics as kSpecular.
std::unique_ptr<Converter> asset_converter(const char* source, const char* target, double prior,
                                           InstructionSet set, bool has_dielectric = false);

// Linear, 0 to 1.
struct MetalRoughFactors {
  std::array<float, 3> base_color = {1.0f, 1.0f, 1.0f};
  float metallic = 1.0f;
  float roughness = 1.0f;
  float residual = 0.0f;  // what metal-rough cannot represent (Parameter::kResidual)
};

// The result of a conversion to gltf, with its diagnosis.
MetalRoughFactors metal_rough_of(const MaterialValues& values);

// 1 - glossiness, rounded once.
float roughness_of(double glossiness);

// ((ior - 1) / (ior + 1))^2; of 0, which stands for a very large index, 1 (KHR_materials_ior).
double f0_of_index(double ior);

}  // namespace remap
