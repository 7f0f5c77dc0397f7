#include "study/study_options.hpp"

#include <iostream>
#include <set>
#include <utility>

#include "build/fit_folder.hpp"
#include "command_line/run_app.hpp"
#include "core/files.hpp"
#include "core/number_text.hpp"
#include "remap/error.hpp"
#include "renderer/image_file.hpp"
#include "report/gnuplot.hpp"
#include "table/table_file.hpp"

namespace remap {

void add_environment_options(Command& app, EnvironmentOptions& options) {
  app.add_option(
         "--environment", options.files,
         "Environment map in latitude and longitude (HDR, EXR), repeatable; default: built-in clear sky, "
         "overcast sky and studio")
      ->allow_extra_args(false);
  app.add_option("--exposure", options.exposure, "Scale every environment to this mean luminance");
}

std::vector<Environment> read_environments(const EnvironmentOptions& options) {
  if (!(options.exposure > 0.0))
    throw Error(ErrorKind::kUsage,
                "--exposure: " + number_text(options.exposure) + " is out of range (must be above 0)");
  std::vector<Environment> environments;
  for (const auto& path : options.files) environments.push_back(load_environment(path));
  if (environments.empty()) environments = builtin_environments();
  for (Environment& environment : environments) {
    const double exposure = options.exposure / mean_luminance(environment);
    environment = exposed(std::move(environment), exposure);
  }
  return environments;
}

void add_sampling_options(Command& app, SphereSampling& sampling) {
  app.add_option("--resolution", sampling.resolution, "Width and height of the pictures in pixels");
  app.add_option("--samples", sampling.samples, "Light directions per pixel");
}

void add_output_options(Command& app, OutputOptions& options, unsigned& jobs, const OutputTexts& texts) {
  app.add_option("-o,--output", options.folder, texts.folder);
  app.add_flag("--pictures", options.pictures, texts.pictures);
  app.add_flag("--force", options.force, "Overwrite results that exist");
  app.add_option("--jobs", jobs, "Number of threads; 0: one per core. " + texts.jobs);
  app.add_flag("--json", options.json, texts.json);
  app.add_flag("--quiet", options.quiet, "Do not show progress");
}

std::filesystem::path fit_folder_of(const std::filesystem::path& given) {
  if (!given.empty()) return given;
  const std::filesystem::path usual = default_fit_folder();
  return std::filesystem::is_directory(usual) ? usual : std::filesystem::path();
}

void require_folder_for_pictures(const OutputOptions& options) {
  if (options.pictures && options.folder.empty())
    throw Error(ErrorKind::kUsage, "--pictures requires -o FOLDER");
}

void prepare_folder(const OutputOptions& options, const std::string& name) {
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

std::vector<std::string> write_report(const OutputOptions& options, const StudyReport& report) {
  std::vector<std::string> names;
  for (const auto& [name, text] : report.tables) {
    write_plain_table(options.folder / name, text);
    names.push_back(name);
  }
  for (const auto& [name, sheet] : report.sheets) {
    write_png(options.folder / name, sheet);
    names.push_back(name);
  }
  for (const auto& [name, script] : report.plots) try {
      write_drawing(options.folder / name, script);
      names.push_back(name);
    } catch (const Error& error) {
      print_message("remap-study", "warning: " + name + " was not drawn: " + error.what());
    }
  return names;
}

void show_report(const OutputOptions& options, const StudyReport& report) {
  if (!options.folder.empty()) write_report(options, report);
  std::cout << (options.json ? report.figures.dump(2) + "\n" : report.summary);
}

}  // namespace remap
