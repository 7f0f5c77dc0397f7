// This file lets sweeps use a real renderer. It runs several processes of one worker, and keeps their
// pictures on disk, so that no picture is rendered twice.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "look/image.hpp"
#include "renderer/renderer.hpp"
#include "worker/folders.hpp"
#include "worker/protocol.hpp"
#include "worker/worker.hpp"

namespace remap {

// A PictureCache stores the pictures of one version of one renderer. Its folder is named after both. It is
// safe for many threads and processes. A picture appears complete or not at all.
class PictureCache {
 public:
  // `renderer` is WorkerDescription::renderer.
  PictureCache(const std::filesystem::path& folder, const std::string& worker, const std::string& renderer);

  // Returns the picture of a request, if the cache has it. If its file cannot be used, `damage` receives the
  // reason (`FILE: its checksum does not match its content`).
  std::optional<Image> find(const PictureRequest& request, std::string& damage) const;

  // Throws kOutput if the picture cannot be written.
  void keep(const PictureRequest& request, const Image& image) const;

  // Returns the names of the folders that hold pictures of other versions of this worker.
  std::vector<std::string> other_versions() const;

 private:
  std::filesystem::path file_of(const PictureRequest& request) const;

  std::string key_opening_;
  std::filesystem::path worker_folder_, folder_;
};

// A PictureCount holds counts and costs of the pictures that a renderer has returned so far.
struct PictureCount {
  std::size_t rendered = 0;
  std::size_t cached = 0;
  std::size_t lost_workers = 0;  // lost processes whose picture another process rendered
};

class WorkerRenderer final : public Renderer {
 public:
  // Starts one process to get its description. More processes start when pictures are requested in parallel.
  // Throws like Worker, and throws kOutput if the folder cannot be used.
  WorkerRenderer(WorkerEntry entry, WorkerSettings settings);
  ~WorkerRenderer() override;

  std::string version() const override { return description_.renderer; }
  std::vector<ModelDescription> models() const override { return description_.models; }
  Image render(const Material& material, const Scene& scene) const override;

  PictureCount pictures() const;
  // Returns remarks for the user about lost processes, damaged pictures, and pictures of other versions in
  // the cache. The first loss and the first damage are not repeated, because a warning has reported them.
  std::vector<std::string> remarks() const;

 private:
  class Turn;
  class Lease;

  std::unique_ptr<Worker> start() const;
  std::unique_ptr<Worker> start_another() const;  // throws if its version differs from the first worker's
  std::unique_ptr<Worker> idle_worker() const;    // null if the caller may start a worker
  void give_back(std::unique_ptr<Worker> worker) const;
  void accept_loss(const LostWorker& lost, int losses) const;
  Image render_anew(const PictureRequest& request) const;
  std::optional<Image> cached(const PictureRequest& request) const;
  void keep(const PictureRequest& request, const Image& image) const;
  void warn(const std::string& message) const;
  void warn_of_cache(const std::string& message) const;

  const WorkerEntry entry_;
  const WorkerSettings settings_;
  PrivateFolder folder_;
  WorkerDescription description_;
  std::optional<PictureCache> cache_;

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  mutable std::vector<std::unique_ptr<Worker>> idle_;
  mutable std::size_t running_ = 0;        // number of running processes
  mutable std::set<std::string> in_work_;  // pictures that a thread is rendering
  mutable std::atomic<std::size_t> next_file_{0}, rendered_{0}, cached_{0}, damaged_{0}, lost_{0};
  mutable std::atomic<bool> keeps_{true};  // becomes false when a picture cannot be written
};

}  // namespace remap
