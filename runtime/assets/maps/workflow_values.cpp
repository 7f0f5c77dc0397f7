#include "assets/maps/workflow_values.hpp"

#include "stages/workflow_stages.hpp"

namespace remap {

std::unique_ptr<Converter> asset_converter(const char* source, const char* target, double prior,
                                           InstructionSet set, bool has_dielectric) {
  WorkflowStages stages{find_workflow_model(source)->end, find_workflow_model(target)->end};
  stages.width = RoughnessEncoding::kRoughness;
  stages.prior = prior;
  return has_dielectric ? make_dielectric_converter(stages, set) : make_workflow_converter(stages, set);
}

MetalRoughFactors metal_rough_of(const MaterialValues& values) {
  const std::vector<float>& base = values.at(Parameter::kBaseColor);
  return {{base[0], base[1], base[2]},
          values.at(Parameter::kMetallic)[0],
          values.at(Parameter::kRoughness)[0],
          values.at(Parameter::kResidual)[0]};
}

float roughness_of(double glossiness) { return static_cast<float>(1.0 - glossiness); }

double f0_of_index(double ior) {
  const double root = ior == 0.0 ? 1.0 : (ior - 1.0) / (ior + 1.0);
  return root * root;
}

}  // namespace remap
