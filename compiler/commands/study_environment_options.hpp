// The environments of a study, as options say them.
#pragma once

#include <filesystem>
#include <vector>

#include <CLI/CLI.hpp>

#include "study/environment.hpp"

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

}  // namespace remapc
