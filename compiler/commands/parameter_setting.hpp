// Reads `NAME=VALUE` and `NAME=R,G,B`, which set parameters of a model on the command line.
#pragma once

#include <string>
#include <vector>

namespace remapc {

struct ParameterSetting {
  std::string name;
  std::vector<double> values;
};

// `option` is named in errors. Throws kUsage.
ParameterSetting parse_setting(const std::string& option, const std::string& text);

// The comma-separated numbers in `text`. Throws kUsage.
std::vector<double> parse_values(const std::string& option, const std::string& text);

}  // namespace remapc
