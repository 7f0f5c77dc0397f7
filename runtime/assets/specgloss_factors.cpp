#include "assets/specgloss_factors.hpp"

#include <cstddef>

namespace remap {
namespace {

using Row = std::vector<float>;

template <std::size_t Count>
std::array<Row, Count> rows_of(std::size_t count) {
  std::array<Row, Count> rows;
  rows.fill(Row(count));
  return rows;
}

}  // namespace

std::unique_ptr<Converter> specgloss_projection(double prior, InstructionSet set) {
  WorkflowStages stages{find_workflow_model("gltf-specgloss")->end, find_workflow_model("gltf")->end};
  stages.width = RoughnessConvention::kRoughness;
  stages.prior = prior;
  return make_workflow_converter(stages, set);
}

float roughness_of(double glossiness) { return static_cast<float>(1.0 - glossiness); }

std::vector<MetalRoughFactors> projected(const std::vector<SpecGlossFactors>& materials, double prior,
                                         InstructionSet set) {
  const std::size_t count = materials.size();
  std::array<Row, 3> diffuse = rows_of<3>(count), specular = rows_of<3>(count), base = rows_of<3>(count);
  Row roughness(count), metallic(count), residual(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      diffuse[c][i] = static_cast<float>(materials[i].diffuse[c]);
      specular[c][i] = static_cast<float>(materials[i].specular[c]);
    }
    roughness[i] = roughness_of(materials[i].glossiness);
  }
  MaterialRows<const float> in;
  in[Parameter::kDiffuse] = {{diffuse[0].data(), diffuse[1].data(), diffuse[2].data()}, 3};
  in[Parameter::kSpecular] = {{specular[0].data(), specular[1].data(), specular[2].data()}, 3};
  in[Parameter::kRoughness] = {{roughness.data()}, 1};
  MaterialRows<float> out;
  out[Parameter::kBaseColor] = {{base[0].data(), base[1].data(), base[2].data()}, 3};
  out[Parameter::kMetallic] = {{metallic.data()}, 1};
  out[Parameter::kResidual] = {{residual.data()}, 1};
  specgloss_projection(prior, set)->convert(count, in, out);
  std::vector<MetalRoughFactors> results(count);
  for (std::size_t i = 0; i < count; ++i)
    results[i] = {{base[0][i], base[1][i], base[2][i]}, metallic[i], roughness[i], residual[i]};
  return results;
}

}  // namespace remap
