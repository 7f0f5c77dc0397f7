// The options of commands that name models: which workers there are, and what is kept of their pictures.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "worker/renderer_set.hpp"

namespace remapc {

struct RendererOptions {
  std::vector<std::string> workers;  // NAME=COMMAND
  std::filesystem::path cache;       // empty: the default folder
  bool no_cache = false;
  unsigned processes = 0;
  double seconds = WorkerLimits{}.seconds;
};

// `options` must live as long as the callback of `app`.
void add_renderer_options(CLI::App& app, RendererOptions& options);

WorkerSettings worker_settings(const RendererOptions& options);

// The built-in renderer and all known workers.
std::unique_ptr<RendererSet> make_renderers(const RendererOptions& options);

}  // namespace remapc
