#include "worker/renderer_options.hpp"

#include "command_line/command.hpp"
#include "command_line/interruption.hpp"
#include "command_line/run_app.hpp"
#include "worker/renderer_set.hpp"

namespace remap {

void add_renderer_options(Command& app, RendererOptions& options) {
  app.option_group("Rare: external renderers (remapc renderers lists them)");
  app.add_option("--worker NAME=COMMAND", options.workers,
                 "Command of a worker for models NAME/..., as compiler/adapters/PROTOCOL.md describes it; "
                 "may be repeated")
      ->allow_extra_args(false);
  app.add_option("--worker-folder FOLDER", options.settings.folder,
                 "Existing folder in which workers write their pictures; if workers run on other machines, a "
                 "folder that all machines share (default: in memory)");
  app.add_option("--worker-processes", options.settings.processes,
                 "Processes of one worker at once, at most; 0: one per core");
  app.add_option("--worker-timeout", options.settings.seconds, "Seconds to wait for an answer of a worker")
      ->positive();
  app.add_option("--cache FOLDER", options.cache,
                 "Folder for pictures of workers (default: remap/pictures in the user's cache)");
  app.add_flag("--no-cache", options.no_cache, "Render every picture again, and keep none in the cache");
}

WorkerSettings worker_settings(const RendererOptions& options) {
  WorkerSettings settings = options.settings;
  if (!options.no_cache) settings.cache = options.cache.empty() ? default_cache_folder() : options.cache;
  settings.cancelled = &interruption();
  settings.on_start = watch_interruptions;
  settings.on_warning = [](const std::string& message) { print_message("remapc", "warning: " + message); };
  return settings;
}

std::unique_ptr<RendererSet> make_renderers(const RendererOptions& options) {
  return std::make_unique<RendererSet>(known_workers(options.workers), worker_settings(options));
}

}  // namespace remap
