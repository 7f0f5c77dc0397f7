// This file declares the subcommands of `remap-study`, and holds the options that the studies share:
// environment maps, rendering, progress and output.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "command_line/command.hpp"
#include "command_line/progress.hpp"
#include "look/environment.hpp"
#include "look/lit_sphere.hpp"

namespace remap {

struct StudyOptions {
  std::vector<std::filesystem::path> environments;  // if empty, the built-in environments
  double exposure = 1.0;                            // mean luminance of each environment after scaling
  std::filesystem::path fit_folder;                 // if empty, the default folder if it exists
  std::filesystem::path folder;                     // folder of the results; if empty, standard output
  bool pictures = false, force = false, quiet = false;
};

// Adds `--environment` and `--exposure`. The options must outlive the parsing, here and in the following
// functions.
void add_environment_options(Command& app, StudyOptions& options);

// Adds `--resolution` and `--samples`.
void add_sampling_options(Command& app, SphereSampling& sampling);

// Adds `-o`, `--force`, `--jobs` and `--quiet`. If `pictures` has a text, also adds `--pictures`. The texts
// are for the help.
void add_output_options(Command& app, StudyOptions& options, unsigned& jobs, const std::string& folder_text,
                        const std::string& pictures_text = "");

// Reads the environments and scales them to the same mean luminance, so that each has the same weight in the
// means and none is overexposed. Throws kUsage if the exposure is not above 0, and the errors of
// load_environment.
std::vector<Environment> read_environments(const StudyOptions& options);

// Returns the folder of fits that the user chose, otherwise the default folder. Returns an empty path if
// there is none.
std::filesystem::path fit_folder_of(const StudyOptions& options);

// Creates the output folder for the results of the study `name`. Throws kUsage for pictures without a folder.
// Throws kOutput if the folder cannot be created, or holds results of the study without `--force`.
void prepare_folder(const StudyOptions& options, const std::string& name);

// Runs `study` until it ends or is interrupted, and prints its progress under `name`.
template <typename Options, typename Study>
auto run_study(const std::string& name, Options& options, const StudyOptions& shared, const Study& study) {
  prepare_folder(shared, name);
  watch_interruptions();
  Progress progress(name, progress_steps(options), !shared.quiet);
  options.progress = [&] { progress.advance(); };
  options.cancelled = &interruption();
  return study(options);
}

// Writes a table to FOLDER/NAME.csv and its comments to FOLDER/NAME.csv.json. Without a folder, prints both.
void write_results(const StudyOptions& options, const std::string& name, const std::string& table);

// Writes one sheet for each environment to FOLDER/PREFIX_<environment>.png.
void write_sheets(const StudyOptions& options, const std::string& prefix,
                  const std::vector<Environment>& environments, const std::vector<Image>& sheets);

void add_environments_study(Command& study);
void add_reach_study(Command& study);
void add_workflows_study(Command& study);

}  // namespace remap
