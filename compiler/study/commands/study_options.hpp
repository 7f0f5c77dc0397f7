// What the studies under environments have in common: where their light comes from, how it is rendered, and
// where results go.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "command_line/interruption.hpp"
#include "command_line/progress.hpp"
#include "report/environment.hpp"

namespace remapc {

struct EnvironmentOptions {
  std::vector<std::filesystem::path> files;  // empty: the built-in ones
  double exposure = 1.0;                     // mean luminance of every environment
};

// `--environment`, `--exposure`. `options` must outlive the parsing.
void add_environment_options(CLI::App& app, EnvironmentOptions& options);

// All as bright as each other, so that each shows in the figures and none is all white. Throws kUsage for an
// exposure that is not above 0, and as load_environment does.
std::vector<Environment> read_environments(const EnvironmentOptions& options);

struct OutputOptions {
  std::filesystem::path fit_folder;  // empty: `fits`, where there is such a folder
  std::filesystem::path folder;      // of the results; empty: none are written
  bool pictures = false, json = false, quiet = false;
};

// What an option says of itself, where studies differ.
struct OutputTexts {
  std::string fits, folder, pictures, json;
};

// `--fits`, `-o`, `--pictures`, `--json`, `--quiet`, and of `study` `--resolution`, `--samples` and `--jobs`.
// Both must outlive the parsing.
template <typename Study>
void add_output_options(CLI::App& app, OutputOptions& options, Study& study, const OutputTexts& texts) {
  app.add_option("--resolution", study.resolution, "Width and height of the pictures")->capture_default_str();
  app.add_option("--samples", study.samples, "Directions a pixel")->capture_default_str();
  app.add_option("--fits", options.fit_folder, texts.fits + "; default: fits, if there is one");
  app.add_option("-o,--output", options.folder, texts.folder);
  app.add_flag("--pictures", options.pictures, texts.pictures);
  app.add_option("--jobs", study.jobs, "Threads; 0: one a core. The figures do not depend on it")
      ->capture_default_str();
  app.add_flag("--json", options.json, texts.json);
  app.add_flag("--quiet", options.quiet, "No progress");
}

// The folder of fits that is meant; empty where none is there.
std::filesystem::path fit_folder_of(const OutputOptions& options);

// Throws kUsage for pictures without a folder.
void require_folder_for_pictures(const OutputOptions& options);

// Runs `study` with a line of progress of that name, until it is done or interrupted.
template <typename Options, typename Study>
auto run_study(const std::string& name, Options& options, bool quiet, const Study& study) {
  remap::watch_interruptions();
  remap::Progress progress(name, progress_steps(options), !quiet);
  options.progress = [&] { progress.advance(); };
  options.cancelled = &remap::interruption();
  return study(options);
}

// Pictures as `<name>_<environment>.png`.
void write_sheets(const std::filesystem::path& folder, const std::string& name,
                  const std::vector<Environment>& environments, const std::vector<Image>& sheets);

// What gnuplot draws of `script`; a warning where it cannot.
void write_plot(const std::filesystem::path& path, const std::string& script);

}  // namespace remapc
