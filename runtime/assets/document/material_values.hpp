// One material without maps: its parameters as values, converted as the texels of maps are.
#pragma once

#include <map>
#include <vector>

#include "remap/converter.hpp"

namespace remap {

using MaterialValues = std::map<Parameter, std::vector<float>>;  // one value, or red, green and blue

// All targets of the converter, of all its sources.
MaterialValues converted(const Converter& converter, const MaterialValues& material);

}  // namespace remap
