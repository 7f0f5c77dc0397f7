// This file converts materials of assets that have no maps, and returns factors of core glTF.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <vector>

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

}  // namespace remap
