// Reads values of the command line: parameters of a model, and a light.
#pragma once

#include <string>
#include <vector>

#include "renderer/scene.hpp"

namespace remapc {

struct ParameterSetting {
  std::string name;
  std::vector<double> values;
};

// Reads `NAME=VALUE` or `NAME=R,G,B`. `option` is named in errors. Throws kUsage.
ParameterSetting parse_setting(const std::string& option, const std::string& text);

// Reads the one light of --light. Throws kUsage.
Light parse_light(const std::string& text, double distance);

}  // namespace remapc
