// `NAME=VALUE` and `NAME=R,G,B`, as command lines give values to parameters of a model.
#pragma once

#include <string>
#include <vector>

namespace remapc {

struct ParameterSetting {
  std::string name;
  std::vector<double> values;
};

// `option` is named in complaints. Throws kUsage.
ParameterSetting parse_setting(const std::string& option, const std::string& text);

// Numbers parted by commas, in `text` of the option. Throws kUsage.
std::vector<double> parse_values(const std::string& option, const std::string& text);

}  // namespace remapc
