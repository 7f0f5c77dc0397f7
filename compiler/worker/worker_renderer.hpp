// A real renderer behind the interface of the sweep: several processes of one worker, and the pictures that
// they made before.
#pragma once

#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "renderer/renderer.hpp"
#include "worker/folders.hpp"
#include "worker/picture_cache.hpp"
#include "worker/worker.hpp"

namespace remapc {

// How workers are run and their pictures kept.
struct WorkerSettings {
  std::optional<std::filesystem::path> cache;  // none: every picture is rendered
  unsigned processes = 0;                      // of one worker at once, at most; 0: one a core
  WorkerLimits limits;
  std::function<void()> on_picture;  // after every picture, from any thread
};

// Pictures that a renderer has given so far.
struct PictureCount {
  std::size_t rendered = 0;
  std::size_t cached = 0;
};

class WorkerRenderer final : public Renderer {
 public:
  // Starts one process, to know what it is; further ones when pictures are asked for side by side. Throws as
  // Worker does.
  WorkerRenderer(WorkerEntry entry, WorkerSettings settings);
  ~WorkerRenderer() override;

  std::string version() const override { return description_.renderer; }
  std::vector<ModelDescription> models() const override { return description_.models; }
  Image render(const Material& material, const Scene& scene) const override;

  PictureCount pictures() const;
  // What a person should know: pictures of other versions that lie in the cache.
  std::vector<std::string> remarks() const;

 private:
  class Turn;

  std::unique_ptr<Worker> start() const;
  std::unique_ptr<Worker> start_another() const;  // of the same version as the first
  std::unique_ptr<Worker> take_worker() const;
  void give_back(std::unique_ptr<Worker> worker) const;
  Image render_anew(const PictureRequest& request) const;

  const WorkerEntry entry_;
  const WorkerSettings settings_;
  PrivateFolder folder_;
  WorkerDescription description_;
  std::optional<PictureCache> cache_;

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  mutable std::vector<std::unique_ptr<Worker>> idle_;
  mutable std::size_t running_ = 0;        // idle or at work
  mutable std::set<std::string> in_work_;  // pictures that some thread renders now
  mutable std::atomic<std::size_t> next_file_{0}, rendered_{0}, cached_{0};
};

}  // namespace remapc
