#include "assets/maps/workflow_values.hpp"

#include <cstddef>

#include "stages/workflow_stages.hpp"

namespace remap {

MaterialValues converted(const Converter& converter, const MaterialValues& material) {
  MaterialRows<const float> in;
  for (const auto& [parameter, values] : material) {
    in[parameter].count = values.size();
    for (std::size_t c = 0; c < values.size(); ++c) in[parameter].row[c] = &values[c];
  }
  MaterialValues result;
  MaterialRows<float> out;
  for (const Parameter parameter : converter.targets()) {
    std::vector<float>& values = result[parameter];
    values.resize(is_color(parameter) ? 3 : 1);
    out[parameter].count = values.size();
    for (std::size_t c = 0; c < values.size(); ++c) out[parameter].row[c] = &values[c];
  }
  converter.convert(1, in, out);
  return result;
}

std::unique_ptr<Converter> asset_converter(const char* source, const char* target, double prior,
                                           InstructionSet set, bool has_dielectric) {
  WorkflowStages stages{find_workflow_model(source)->end, find_workflow_model(target)->end};
  stages.width = RoughnessEncoding::kRoughness;
  stages.prior = prior;
  return has_dielectric ? make_dielectric_converter(stages, set) : make_workflow_converter(stages, set);
}

float roughness_of(double glossiness) { return static_cast<float>(1.0 - glossiness); }

double f0_of_index(double ior) {
  const double root = ior == 0.0 ? 1.0 : (ior - 1.0) / (ior + 1.0);
  return root * root;
}

}  // namespace remap
