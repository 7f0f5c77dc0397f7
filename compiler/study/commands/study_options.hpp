// Command line options that several studies share: environment maps, rendering and output files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "command_line/command.hpp"
#include "command_line/interruption.hpp"
#include "command_line/progress.hpp"
#include "report/environment.hpp"

namespace remapc {

struct EnvironmentOptions {
  std::vector<std::filesystem::path> files;  // empty: use the built-in environments
  double exposure = 1.0;                     // mean luminance after scaling
};

// Adds `--environment` and `--exposure`. `options` must outlive the parsing.
void add_environment_options(remap::Command& app, EnvironmentOptions& options);

// Reads the environments and scales them to the same mean luminance, so that each of them counts in the
// means and none is overexposed. Throws kUsage if the exposure is not above 0, and the errors of
// load_environment.
std::vector<Environment> read_environments(const EnvironmentOptions& options);

struct OutputOptions {
  std::filesystem::path fit_folder;  // empty: `fits` if that folder exists
  std::filesystem::path folder;      // of the results; empty: write nothing
  bool pictures = false, json = false, quiet = false;
};

// Help texts that differ between the studies.
struct OutputTexts {
  std::string fits, folder, pictures, json;
};

// Adds `--fits`, `-o`, `--pictures`, `--json` and `--quiet` for `options`, and `--resolution`, `--samples`
// and
// `--jobs` for `study`. Both must outlive the parsing.
template <typename Study>
void add_output_options(remap::Command& app, OutputOptions& options, Study& study, const OutputTexts& texts) {
  app.add_option("--resolution", study.resolution, "Width and height of the pictures in pixels")
      ->capture_default_str();
  app.add_option("--samples", study.samples, "Light directions per pixel")->capture_default_str();
  app.add_option("--fits", options.fit_folder, texts.fits + "; default: fits, if it exists");
  app.add_option("-o,--output", options.folder, texts.folder);
  app.add_flag("--pictures", options.pictures, texts.pictures);
  app.add_option("--jobs", study.jobs, "Number of threads; 0: one per core. Results do not depend on it")
      ->capture_default_str();
  app.add_flag("--json", options.json, texts.json);
  app.add_flag("--quiet", options.quiet, "Do not show progress");
}

// The folder of fits to use; empty if there is none.
std::filesystem::path fit_folder_of(const OutputOptions& options);

// Throws kUsage if pictures are wanted without an output folder.
void require_folder_for_pictures(const OutputOptions& options);

// Runs `study` until it ends or is interrupted, and prints its progress under `name`.
template <typename Options, typename Study>
auto run_study(const std::string& name, Options& options, bool quiet, const Study& study) {
  remap::watch_interruptions();
  remap::Progress progress(name, progress_steps(options), !quiet);
  options.progress = [&] { progress.advance(); };
  options.cancelled = &remap::interruption();
  return study(options);
}

// Writes each sheet as `<name>_<environment>.png`.
void write_sheets(const std::filesystem::path& folder, const std::string& name,
                  const std::vector<Environment>& environments, const std::vector<Image>& sheets);

// Writes the plot of a gnuplot script. Prints a warning and returns false if gnuplot is missing or fails.
bool write_plot(const std::filesystem::path& path, const std::string& script);

}  // namespace remapc
