#include "assets/maps/specgloss_factors.hpp"

#include <cstddef>

#include "assets/document/material_values.hpp"

namespace remap {
namespace {

std::vector<float> float_color(const std::array<double, 3>& color) {
  return {static_cast<float>(color[0]), static_cast<float>(color[1]), static_cast<float>(color[2])};
}

}  // namespace

std::unique_ptr<Converter> specgloss_projection(double prior, InstructionSet set) {
  WorkflowStages stages{find_workflow_model("gltf-specgloss")->end, find_workflow_model("gltf")->end};
  stages.width = RoughnessEncoding::kRoughness;
  stages.prior = prior;
  return make_workflow_converter(stages, set);
}

float roughness_of(double glossiness) { return static_cast<float>(1.0 - glossiness); }

MetalRoughFactors metal_rough_of(const MaterialValues& values) {
  const std::vector<float>& base = values.at(Parameter::kBaseColor);
  return {{base[0], base[1], base[2]},
          values.at(Parameter::kMetallic)[0],
          values.at(Parameter::kRoughness)[0],
          values.at(Parameter::kResidual)[0]};
}

MetalRoughFactors projected(const SpecGlossFactors& material, const Converter& converter) {
  return metal_rough_of(converted(converter, {{Parameter::kDiffuse, float_color(material.diffuse)},
                                              {Parameter::kSpecular, float_color(material.specular)},
                                              {Parameter::kRoughness, {roughness_of(material.glossiness)}}}));
}

std::vector<MetalRoughFactors> projected(const std::vector<SpecGlossFactors>& materials, double prior,
                                         InstructionSet set) {
  const std::unique_ptr<Converter> converter = specgloss_projection(prior, set);
  std::vector<MetalRoughFactors> results;
  results.reserve(materials.size());
  for (const SpecGlossFactors& material : materials) results.push_back(projected(material, *converter));
  return results;
}

}  // namespace remap
