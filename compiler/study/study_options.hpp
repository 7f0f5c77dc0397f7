// Options that the studies share: environment maps, rendering, progress and output.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "command_line/command.hpp"
#include "command_line/interruption.hpp"
#include "command_line/progress.hpp"
#include "lights/environment.hpp"
#include "lights/lit_sphere.hpp"
#include "study/study_report.hpp"

namespace remap {

struct EnvironmentOptions {
  std::vector<std::filesystem::path> files;  // empty: use the built-in environments
  double exposure = 1.0;                     // mean luminance after scaling
};

// Adds `--environment` and `--exposure`. `options` must outlive the parsing.
void add_environment_options(Command& app, EnvironmentOptions& options);

// Reads the environments and scales them to the same mean luminance, so that each of them counts in the
// means and none is overexposed. Throws kUsage if the exposure is not above 0, and the errors of
// load_environment.
std::vector<Environment> read_environments(const EnvironmentOptions& options);

struct OutputOptions {
  std::filesystem::path folder;  // of the results; empty: write nothing
  bool pictures = false, force = false, json = false, quiet = false;
};

// Help texts that differ between the studies.
struct OutputTexts {
  std::string folder, pictures, jobs, json;
};

// Adds `--resolution` and `--samples`. `sampling` must outlive the parsing.
void add_sampling_options(Command& app, SphereSampling& sampling);

// Adds `-o`, `--pictures`, `--force`, `--jobs`, `--json` and `--quiet`. `options` and `jobs` must outlive the
// parsing.
void add_output_options(Command& app, OutputOptions& options, unsigned& jobs, const OutputTexts& texts);

// The folder of fits that the user named, else the default; empty if that does not exist.
std::filesystem::path fit_folder_of(const std::filesystem::path& given);

// Throws kUsage if pictures are wanted without an output folder.
void require_folder_for_pictures(const OutputOptions& options);

// Creates the output folder for the results of the study `name`. Throws kOutput if that fails, or if results
// of it are there that `--force` does not give up.
void prepare_folder(const OutputOptions& options, const std::string& name);

// Runs `study` until it ends or is interrupted, and prints its progress under `name`.
template <typename Options, typename Study>
auto run_study(const std::string& name, Options& options, const OutputOptions& output, const Study& study) {
  prepare_folder(output, name);
  watch_interruptions();
  Progress progress(name, progress_steps(options), !output.quiet);
  options.progress = [&] { progress.advance(); };
  options.cancelled = &interruption();
  return study(options);
}

// Writes the files of a report to the output folder and returns their names. Prints a warning if gnuplot is
// missing or fails, and leaves plots out.
std::vector<std::string> write_report(const OutputOptions& options, const StudyReport& report);

// Writes the files, if there is a folder for them, and prints the summary or the figures.
void show_report(const OutputOptions& options, const StudyReport& report);

}  // namespace remap
