// Every renderer there is as one: the built-in models, and those of workers, which are started when a model
// with their prefix is first asked for.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "renderer/renderer.hpp"
#include "worker/worker_renderer.hpp"

namespace remapc {

class RendererSet final : public Renderer {
 public:
  RendererSet(std::vector<WorkerEntry> workers, WorkerSettings settings);
  ~RendererSet() override;

  // That of the built-in renderer, and of workers that have been started.
  std::string version() const override;
  std::string version_of(const std::string& model) const override;
  // Starts no worker: the built-in models, and those of workers that have been started.
  std::vector<ModelDescription> models() const override;
  ModelDescription model(const std::string& name) const override;
  Image render(const Material& material, const Scene& scene) const override;

  // Of workers; the built-in renderer is not counted.
  PictureCount pictures() const;
  // `watcher` hears of every picture of a worker, from any thread; none: nobody does.
  void watch(std::function<void(const PictureCount&)> watcher);
  std::vector<std::string> remarks() const;

 private:
  // The renderer of a model by its prefix; the built-in one where no worker has that prefix.
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

}  // namespace remapc
