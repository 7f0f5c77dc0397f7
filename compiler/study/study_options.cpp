#include "study/study_options.hpp"

#include <iostream>
#include <set>
#include <utility>

#include "build/fit_folder.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/number_text.hpp"
#include "look/image.hpp"
#include "table/csv.hpp"

namespace remap {

void add_environment_options(Command& app, StudyOptions& options) {
  app.add_option(
         "--environment", options.environments,
         "Environment map in latitude and longitude (HDR, EXR), repeatable; default: built-in clear sky, "
         "overcast sky and studio")
      ->allow_extra_args(false);
  app.add_option("--exposure", options.exposure, "Scale every environment to this mean luminance");
}

void add_sampling_options(Command& app, SphereSampling& sampling) {
  app.add_option("--resolution", sampling.resolution, "Width and height of the pictures in pixels");
  app.add_option("--samples", sampling.samples, "Light directions per pixel");
}

void add_output_options(Command& app, StudyOptions& options, unsigned& jobs, const std::string& folder_text,
                        const std::string& pictures_text) {
  app.add_option("-o,--output FOLDER", options.folder, folder_text);
  if (!pictures_text.empty()) app.add_flag("--pictures", options.pictures, pictures_text);
  app.add_flag("--force", options.force, "Overwrite results that exist");
  app.add_option("--jobs", jobs, "Number of threads; 0: one per core. Results do not depend on it");
  app.add_flag("--quiet", options.quiet, "Do not show progress");
}

std::vector<Environment> read_environments(const StudyOptions& options) {
  if (!(options.exposure > 0.0))
    throw usage_error("--exposure: " + number_text(options.exposure) + " is out of range (must be above 0)");
  std::vector<Environment> environments;
  for (const auto& path : options.environments) environments.push_back(load_environment(path));
  if (environments.empty()) environments = builtin_environments();
  for (Environment& environment : environments) {
    const double exposure = options.exposure / mean_luminance(environment);
    environment = exposed(std::move(environment), exposure);
  }
  return environments;
}

std::filesystem::path fit_folder_of(const StudyOptions& options) {
  if (!options.fit_folder.empty()) return options.fit_folder;
  const std::filesystem::path usual = default_fit_folder();
  return std::filesystem::is_directory(usual) ? usual : std::filesystem::path();
}

void prepare_folder(const StudyOptions& options, const std::string& name) {
  if (options.pictures && options.folder.empty()) throw usage_error("--pictures requires -o FOLDER");
  if (options.folder.empty()) return;
  create_parent(options.folder / "results");
  std::set<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(options.folder)) {
    const std::string file = entry.path().filename().string();
    const bool is_result = file.starts_with(name + ".") || file.starts_with(name + "_");
    if (is_result || (options.pictures && file.starts_with("spheres_"))) found.insert(entry.path());
  }
  for (const std::filesystem::path& path : found) require_new(path, options.force);
}

void write_results(const StudyOptions& options, const std::string& name, const std::string& table) {
  if (options.folder.empty())
    std::cout << table;
  else
    write_plain_table(options.folder / (name + ".csv"), table);
}

void write_sheets(const StudyOptions& options, const std::string& prefix,
                  const std::vector<Environment>& environments, const std::vector<Image>& sheets) {
  for (std::size_t e = 0; e < sheets.size(); ++e)
    write_png(options.folder / (prefix + "_" + environments[e].name + ".png"), sheets[e]);
}

}  // namespace remap
