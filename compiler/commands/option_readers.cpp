#include "commands/option_readers.hpp"

#include <sstream>

#include "build/fit_folder.hpp"
#include "core/errors.hpp"
#include "core/number_text.hpp"

namespace remap {

void add_fits_option(Command& app, std::filesystem::path& folder, const std::string& text) {
  folder = default_fit_folder();
  app.add_option("--fits FOLDER", folder, text)->default_text("fits, or the installed ones");
}

void add_force_flag(Command& app, bool& force) {
  app.add_flag("--force", force, "Overwrite files that exist");
}

Reader<double> light_angle() {
  return {[](const std::string& option, const std::string& word) {
            const auto angle = word == "headlight" ? 0.0 : parse_number(word);
            if (!angle || !(*angle > -180.0 && *angle <= 180.0))
              throw usage_error(option + ": invalid value '" + word +
                                "' (choose headlight, or degrees from -180 to 180)");
            return *angle;
          },
          {}};
}

Reader<Range> number_range() {
  return {[](const std::string& option, const std::string& word) {
            const std::size_t comma = word.find(',');
            const auto min = parse_number(word.substr(0, comma));
            const auto max = comma == std::string::npos ? min : parse_number(word.substr(comma + 1));
            if (comma == std::string::npos || !min || !max || !(*min <= *max))
              throw usage_error(option + ": not a range (write MIN,MAX with MIN not above MAX)");
            return Range{*min, *max};
          },
          {}};
}

ParameterSetting::ParameterSetting(const std::string& option, const std::string& word)
    : context(option + " " + word), name(word.substr(0, word.find('='))) {
  if (name == word) fail("'=' missing (write NAME=VALUE or NAME=R,G,B)");
  std::istringstream items(word.substr(name.size() + 1));
  for (std::string item; std::getline(items, item, ',');) {
    const auto value = parse_number(item);
    if (!value) fail("'" + item + "' is not a number (write NAME=VALUE or NAME=R,G,B)");
    values.push_back(*value);
  }
}

void ParameterSetting::fail(const std::string& reason) const { throw usage_error(context + ": " + reason); }

}  // namespace remap
