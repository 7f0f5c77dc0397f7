// Factors of a material in core glTF, with KHR_materials_specular and _ior, and their converter.
#pragma once

#include <array>
#include <memory>

#include "assets/document/material_values.hpp"
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

// The values that a converter of make_core_converter() takes.
MaterialValues values_of(const CoreFactors& factors, bool has_dielectric);

// From core to a workflow model, with roughness at both ends; with dielectrics of any F0, which are kSpecular
// of its source.
std::unique_ptr<Converter> make_core_converter(const char* target, bool has_dielectric, double prior,
                                               InstructionSet set);

}  // namespace remap
