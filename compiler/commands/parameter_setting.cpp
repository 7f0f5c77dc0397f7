#include "commands/parameter_setting.hpp"

#include <sstream>

#include "remap/error.hpp"
#include "text/number_text.hpp"

namespace remapc {

using remap::Error;
using remap::ErrorKind;

std::vector<double> parse_values(const std::string& option, const std::string& text) {
  std::vector<double> values;
  std::istringstream items(text);
  for (std::string item; std::getline(items, item, ',');) {
    const auto value = remap::parse_number(item);
    if (!value) throw Error(ErrorKind::kUsage, option + ": '" + item + "' is not a number");
    values.push_back(*value);
  }
  return values;
}

ParameterSetting parse_setting(const std::string& option, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw Error(ErrorKind::kUsage, option + " " + text + ": '=' missing (write NAME=VALUE or NAME=R,G,B)");
  return {text.substr(0, equals), parse_values(option + " " + text, text.substr(equals + 1))};
}

}  // namespace remapc
