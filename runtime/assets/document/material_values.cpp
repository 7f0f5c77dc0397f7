#include "assets/document/material_values.hpp"

#include <cstddef>

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

}  // namespace remap
