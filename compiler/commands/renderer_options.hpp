// The options of commands that use models of external renderers: their workers and the cache of their
// pictures.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "command_line/command.hpp"
#include "command_line/progress.hpp"
#include "worker/renderer_set.hpp"

namespace remapc {

struct RendererOptions {
  std::vector<std::string> workers;  // NAME=COMMAND
  std::filesystem::path cache;       // empty: the default folder
  bool no_cache = false;
  unsigned processes = 0;
  double seconds = WorkerLimits{}.seconds;
};

// Adds the options as a rare group. `options` must outlive the callback of `app`.
void add_renderer_options(remap::Command& app, RendererOptions& options);

WorkerSettings worker_settings(const RendererOptions& options);

// The built-in renderer and all known workers. Throws as known_workers() does.
std::unique_ptr<RendererSet> make_renderers(const RendererOptions& options);

// `, 12 pictures rendered and 30 from the cache`; empty if no worker was used.
std::string pictures_text(const PictureCount& pictures);

// A progress line of rows whose label also counts the pictures of workers. `renderers` must outlive it.
class PictureProgress {
 public:
  PictureProgress(RendererSet* renderers, const std::string& label, std::size_t total, bool shown);
  ~PictureProgress();
  PictureProgress(const PictureProgress&) = delete;
  PictureProgress& operator=(const PictureProgress&) = delete;

  void advance_to(std::size_t done) { progress_.advance_to(done); }

 private:
  RendererSet* renderers_;
  remap::Progress progress_;
};

}  // namespace remapc
