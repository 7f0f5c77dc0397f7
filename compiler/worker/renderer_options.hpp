// This file holds the options of commands that use models of external renderers: their workers and the cache
// of their pictures.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "command_line/command.hpp"
#include "worker/renderer_set.hpp"

namespace remap {

struct RendererOptions {
  std::vector<std::string> workers;  // NAME=COMMAND
  std::filesystem::path cache;       // if empty, the default folder
  bool no_cache = false;
  WorkerSettings settings;  // make_renderers() sets its cache
};

// Adds the options as a rare group. `options` must outlive the callback of `app`.
void add_renderer_options(Command& app, RendererOptions& options);

WorkerSettings worker_settings(const RendererOptions& options);

// Returns the built-in renderer and all known workers. Throws like known_workers().
std::unique_ptr<RendererSet> make_renderers(const RendererOptions& options);

}  // namespace remap
