#include "assets/maps/core_factors.hpp"

#include <algorithm>

#include "stages/workflow_stages.hpp"

namespace remap {

double f0_of_index(double ior) {
  const double root = ior == 0.0 ? 1.0 : (ior - 1.0) / (ior + 1.0);
  return root * root;
}

std::array<double, 3> CoreFactors::f0() const {
  std::array<double, 3> values{};
  for (std::size_t c = 0; c < 3; ++c) values[c] = std::min(f0_of_index * specular_color[c], 1.0) * specular;
  return values;
}

MaterialValues values_of(const CoreFactors& factors, bool has_dielectric) {
  const auto color = [](const std::array<double, 3>& values) {
    return std::vector<float>(values.begin(), values.end());
  };
  MaterialValues values = {{Parameter::kBaseColor, color(factors.base_color)},
                           {Parameter::kMetallic, {static_cast<float>(factors.metallic)}},
                           {Parameter::kRoughness, {static_cast<float>(factors.roughness)}}};
  if (has_dielectric) values[Parameter::kSpecular] = color(factors.f0());
  return values;
}

std::unique_ptr<Converter> make_core_converter(const char* target, bool has_dielectric, double prior,
                                               InstructionSet set) {
  WorkflowStages stages{find_workflow_model("gltf")->end, find_workflow_model(target)->end};
  stages.width = RoughnessEncoding::kRoughness;
  stages.prior = prior;
  return has_dielectric ? make_dielectric_converter(stages, set) : make_workflow_converter(stages, set);
}

}  // namespace remap
