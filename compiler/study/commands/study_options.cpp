#include "study/commands/study_options.hpp"

#include <utility>

#include "command_line/run_app.hpp"
#include "remap/error.hpp"
#include "renderer/image_file.hpp"
#include "report/gnuplot.hpp"
#include "text/number_text.hpp"

namespace remapc {

void add_environment_options(remap::Command& app, EnvironmentOptions& options) {
  app.add_option(
         "--environment", options.files,
         "Environment map in latitude and longitude (HDR, EXR), repeatable; default: built-in clear sky, "
         "overcast sky and studio")
      ->allow_extra_args(false);
  app.add_option("--exposure", options.exposure, "Scale every environment to this mean luminance")
      ->capture_default_str();
}

std::vector<Environment> read_environments(const EnvironmentOptions& options) {
  if (!(options.exposure > 0.0))
    throw remap::Error(remap::ErrorKind::kUsage, "--exposure: " + remap::number_text(options.exposure) +
                                                     " is out of range (must be above 0)");
  std::vector<Environment> environments;
  for (const auto& path : options.files) environments.push_back(load_environment(path));
  if (environments.empty()) environments = builtin_environments();
  for (Environment& environment : environments) {
    const double exposure = options.exposure / mean_luminance(environment);
    environment = exposed(std::move(environment), exposure);
  }
  return environments;
}

std::filesystem::path fit_folder_of(const OutputOptions& options) {
  const std::filesystem::path usual = "fits";
  if (!options.fit_folder.empty()) return options.fit_folder;
  return std::filesystem::is_directory(usual) ? usual : std::filesystem::path();
}

void require_folder_for_pictures(const OutputOptions& options) {
  if (options.pictures && options.folder.empty())
    throw remap::Error(remap::ErrorKind::kUsage, "--pictures requires -o FOLDER");
}

void write_sheets(const std::filesystem::path& folder, const std::string& name,
                  const std::vector<Environment>& environments, const std::vector<Image>& sheets) {
  for (std::size_t e = 0; e < sheets.size(); ++e)
    write_png(folder / (name + "_" + environments[e].name + ".png"), sheets[e]);
}

bool write_plot(const std::filesystem::path& path, const std::string& script) {
  try {
    write_svg(path, script);
    return true;
  } catch (const remap::Error& error) {
    remap::print_message("remap-study",
                         "warning: " + path.filename().string() + " was not drawn: " + error.what());
    return false;
  }
}

}  // namespace remapc
