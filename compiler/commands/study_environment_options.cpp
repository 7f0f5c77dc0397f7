#include "commands/study_environment_options.hpp"

#include <utility>

#include "error.hpp"
#include "number_text.hpp"

namespace remapc {

void add_environment_options(CLI::App& app, EnvironmentOptions& options) {
  app.add_option(
         "--environment", options.files,
         "Map in latitude and longitude (HDR, EXR), repeatable; default: a clear sky, an overcast sky "
         "and a studio of its own")
      ->allow_extra_args(false);
  app.add_option("--exposure", options.exposure, "Mean luminance that every environment is brought to")
      ->capture_default_str();
}

std::vector<Environment> read_environments(const EnvironmentOptions& options) {
  if (!(options.exposure > 0.0))
    throw remap::Error(remap::ErrorKind::kUsage,
                       "--exposure: " + remap::number_text(options.exposure) + "; expected more than 0");
  std::vector<Environment> environments;
  for (const auto& path : options.files) environments.push_back(load_environment(path));
  if (environments.empty()) environments = builtin_environments();
  for (Environment& environment : environments) {
    const double exposure = options.exposure / mean_luminance(environment);
    environment = exposed(std::move(environment), exposure);
  }
  return environments;
}

}  // namespace remapc
