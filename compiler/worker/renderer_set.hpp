// This file combines all renderers: the built-in one and workers. It starts a worker when a model with the
// worker's prefix is first requested. Workers come from the command line, the user's list, and the shipped
// list. It also has the options of commands that use models of external renderers.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "command_line/command.hpp"
#include "renderer/renderer.hpp"
#include "worker/worker_renderer.hpp"

namespace remap {

class RendererSet final : public Renderer {
 public:
  RendererSet(std::vector<WorkerEntry> workers, WorkerSettings settings);
  ~RendererSet() override;

  // Returns the names of the built-in renderer and of the workers that have been started.
  std::string version() const override;
  std::string version_of(const std::string& model) const override;
  // Returns the built-in models and the models of workers that run already. Starts no worker.
  std::vector<ModelDescription> models() const override;
  ModelDescription model(const std::string& name) const override;
  // Returns the models of one worker, which it starts. Throws kUsage if no worker has this name.
  std::vector<ModelDescription> models_of(const std::string& worker) const;
  Image render(const Material& material, const Scene& scene) const override;

  // Counts the pictures of workers only.
  PictureCount pictures() const;
  // Sets a function that is called after every picture of a worker, from any thread. An empty function is not
  // called.
  void watch(std::function<void(const PictureCount&)> watcher);
  std::vector<std::string> remarks() const;

 private:
  // Returns the renderer of a model by its prefix, or the built-in one if no worker has that prefix.
  const Renderer& renderer_of(const std::string& model) const;
  std::vector<const WorkerRenderer*> started() const;
  void tell_watcher();

  const std::vector<WorkerEntry> workers_;
  WorkerSettings settings_;
  const std::unique_ptr<Renderer> builtin_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, std::unique_ptr<WorkerRenderer>> started_;
  std::mutex watcher_mutex_;
  std::function<void(const PictureCount&)> watcher_;
};

// Reads the workers of a JSON file (compiler/adapters/PROTOCOL.md, last section). Throws kInput.
std::vector<WorkerEntry> read_worker_list(const std::filesystem::path& path);

// Parses `NAME=COMMAND` of the command line. Throws kUsage.
WorkerEntry parse_worker(const std::string& text);

// Returns all workers by name. If several have the same name, the first is used: from `given`, then from the
// user's list, then from the shipped list. Throws kInput for a list that cannot be read, and kUsage for
// errors in `given`.
std::vector<WorkerEntry> known_workers(const std::vector<std::string>& given);

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
