#include "commands/parameter_setting.hpp"

#include <sstream>

#include "probe/objective.hpp"
#include "text/errors.hpp"
#include "text/number_text.hpp"

namespace remapc {

ParameterSetting parse_setting(const std::string& option, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw usage_error(option + " " + text + ": '=' missing (write NAME=VALUE or NAME=R,G,B)");
  ParameterSetting setting{text.substr(0, equals), {}};
  std::istringstream items(text.substr(equals + 1));
  for (std::string item; std::getline(items, item, ',');) {
    const auto value = remap::parse_number(item);
    if (!value) throw usage_error(option + " " + text + ": '" + item + "' is not a number");
    setting.values.push_back(*value);
  }
  return setting;
}

Light parse_light(const std::string& text, double distance) {
  const std::vector<Light> lights = parse_lights(text, distance);
  if (lights.size() != 1)
    throw usage_error("--light: " + std::to_string(lights.size()) + " lights given (give one)");
  return lights.front();
}

}  // namespace remapc
