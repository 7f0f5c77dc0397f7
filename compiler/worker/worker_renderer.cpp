#include "worker/worker_renderer.hpp"

#include <algorithm>
#include <thread>

#include "error.hpp"
#include "nearest_name.hpp"
#include "number_text.hpp"
#include "sweep/shape.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

unsigned core_count() { return std::max(1u, std::thread::hardware_concurrency()); }

WorkerSettings with_threads(WorkerSettings settings, unsigned processes) {
  settings.limits.threads = std::max(1u, core_count() / processes);
  return settings;
}

// The same complaints as from the built-in renderer, before a worker is asked.
void require_material(const Material& material, const ModelDescription& model) {
  std::vector<std::string> names;
  for (const ParameterDescription& parameter : model.parameters) {
    names.push_back(parameter.name);
    const auto found = material.parameters.find(parameter.name);
    if (found == material.parameters.end())
      throw Error(ErrorKind::kUsage, model.name + ": parameter " + parameter.name + " is missing");
    const std::size_t count = found->second.size();
    const bool one = parameter.grey || parameter.role == ParameterRole::kRoughness;
    if (count != 1 && (one || count != 3))
      throw Error(ErrorKind::kUsage, model.name + ": parameter " + parameter.name + " has " +
                                         std::to_string(count) + " values; expected " +
                                         (one ? "1" : "1 or 3"));
    for (const double value : found->second)
      if (!parameter.range.contains(value))
        throw Error(ErrorKind::kUsage, model.name + ": " + parameter.name + " = " +
                                           remap::number_text(value) + "; expected " +
                                           remap::number_text(parameter.range.min) + " to " +
                                           remap::number_text(parameter.range.max));
  }
  for (const auto& [name, values] : material.parameters)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw Error(ErrorKind::kUsage,
                  model.name + ": has no parameter " + name + remap::suggestion(name, names));
}

}  // namespace

// The right to render one picture: a second thread that wants the same waits until the first is done.
class WorkerRenderer::Turn {
 public:
  Turn(const WorkerRenderer& renderer, const PictureRequest& request)
      : renderer_(renderer), key_(request.text) {
    std::unique_lock lock(renderer_.mutex_);
    renderer_.changed_.wait(lock, [&] { return !renderer_.in_work_.contains(key_); });
    renderer_.in_work_.insert(key_);
  }
  ~Turn() {
    {
      const std::lock_guard lock(renderer_.mutex_);
      renderer_.in_work_.erase(key_);
    }
    renderer_.changed_.notify_all();
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  const WorkerRenderer& renderer_;
  const std::string& key_;
};

WorkerRenderer::WorkerRenderer(WorkerEntry entry, WorkerSettings settings)
    : entry_(std::move(entry)),
      settings_(with_threads(settings, settings.processes == 0 ? core_count() : settings.processes)),
      most_processes_(settings.processes == 0 ? core_count() : settings.processes) {
  auto first = std::make_unique<Worker>(entry_, settings_.limits,
                                        folder_.path() / (std::to_string(next_file_++) + ".f32"));
  description_ = first->description();
  if (settings_.cache) cache_.emplace(*settings_.cache, entry_.name, description_.renderer);
  running_ = 1;
  idle_.push_back(std::move(first));
}

WorkerRenderer::~WorkerRenderer() = default;

std::unique_ptr<Worker> WorkerRenderer::start() const {
  auto worker = std::make_unique<Worker>(entry_, settings_.limits,
                                         folder_.path() / (std::to_string(next_file_++) + ".f32"));
  if (worker->description().renderer != description_.renderer)
    throw Error(ErrorKind::kInput, "worker " + entry_.name + ": is " + worker->description().renderer +
                                       " now; expected " + description_.renderer + ", as before in this run");
  return worker;
}

std::unique_ptr<Worker> WorkerRenderer::take_worker() const {
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !idle_.empty() || running_ < most_processes_; });
    if (!idle_.empty()) {
      auto worker = std::move(idle_.back());
      idle_.pop_back();
      return worker;
    }
    ++running_;
  }
  try {
    return start();
  } catch (...) {
    give_back(nullptr);
    throw;
  }
}

// One that broke is gone with this, and another may be started in its place.
void WorkerRenderer::give_back(std::unique_ptr<Worker> worker) const {
  {
    const std::lock_guard lock(mutex_);
    if (worker != nullptr && worker->is_usable())
      idle_.push_back(std::move(worker));
    else
      --running_;
  }
  changed_.notify_all();
}

Image WorkerRenderer::render_anew(const PictureRequest& request) const {
  std::unique_ptr<Worker> worker = take_worker();
  try {
    Image image = worker->render(request);
    give_back(std::move(worker));
    return image;
  } catch (...) {
    give_back(std::move(worker));
    throw;
  }
}

Image WorkerRenderer::render(const Material& material, const Scene& scene) const {
  require_material(material, model(material.model));
  if (scene.shape != Shape::kSphere && !description_.meshes)
    throw Error(ErrorKind::kUsage,
                "worker " + entry_.name + ": renders spheres only; expected no " + shape_name(scene.shape));
  const PictureRequest request = picture_request(material, scene);
  const Turn turn(*this, request);
  if (cache_) {
    if (auto found = cache_->find(request)) {
      ++cached_;
      return std::move(*found);
    }
  }
  Image image = render_anew(request);
  ++rendered_;
  if (cache_) cache_->keep(request, image);
  return image;
}

PictureCount WorkerRenderer::pictures() const { return {rendered_, cached_}; }

std::vector<std::string> WorkerRenderer::remarks() const {
  std::vector<std::string> remarks;
  if (!cache_) return remarks;
  for (const std::string& version : cache_->other_versions())
    remarks.push_back("worker " + entry_.name + ": the cache " + settings_.cache->string() +
                      " has pictures of " + version + ", which are not used; this is " +
                      description_.renderer);
  return remarks;
}

}  // namespace remapc
