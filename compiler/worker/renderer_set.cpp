#include "worker/renderer_set.hpp"

#include <algorithm>

#include "remap/error.hpp"
#include "text/nearest_name.hpp"

namespace remapc {

RendererSet::RendererSet(std::vector<WorkerEntry> workers, WorkerSettings settings)
    : workers_(std::move(workers)), settings_(std::move(settings)), builtin_(make_builtin_renderer()) {
  settings_.on_picture = [this] { tell_watcher(); };
}

RendererSet::~RendererSet() = default;

std::vector<const WorkerRenderer*> RendererSet::started() const {
  const std::lock_guard lock(mutex_);
  std::vector<const WorkerRenderer*> renderers;
  for (const auto& [name, renderer] : started_) renderers.push_back(renderer.get());
  return renderers;
}

const Renderer& RendererSet::renderer_of(const std::string& model) const {
  const std::string prefix = model.substr(0, model.find('/'));
  const auto entry = std::ranges::find(workers_, prefix, &WorkerEntry::name);
  if (entry == workers_.end()) return *builtin_;
  const std::lock_guard lock(mutex_);
  if (const auto known = started_.find(prefix); known != started_.end()) return *known->second;
  return *started_.emplace(prefix, std::make_unique<WorkerRenderer>(*entry, settings_)).first->second;
}

std::string RendererSet::version() const {
  std::string text = builtin_->version();
  for (const WorkerRenderer* renderer : started()) text += "; " + renderer->version();
  return text;
}

std::string RendererSet::version_of(const std::string& model) const { return renderer_of(model).version(); }

std::vector<ModelDescription> RendererSet::models() const {
  std::vector<ModelDescription> models = builtin_->models();
  for (const WorkerRenderer* renderer : started()) {
    const std::vector<ModelDescription> more = renderer->models();
    models.insert(models.end(), more.begin(), more.end());
  }
  return models;
}

ModelDescription RendererSet::model(const std::string& name) const {
  const Renderer& renderer = renderer_of(name);
  if (&renderer != builtin_.get()) return renderer.model(name);
  std::vector<std::string> names;
  for (const ModelDescription& model : builtin_->models()) {
    if (model.name == name) return model;
    names.push_back(model.name);
  }
  for (const WorkerEntry& worker : workers_) names.push_back(worker.name + "/...");
  throw remap::Error(remap::ErrorKind::kUsage, name + ": unknown model of " + builtin_->version() +
                                                   " and of the workers" + remap::suggestion(name, names));
}

Image RendererSet::render(const Material& material, const Scene& scene) const {
  return renderer_of(material.model).render(material, scene);
}

void RendererSet::watch(std::function<void(const PictureCount&)> watcher) {
  const std::lock_guard lock(watcher_mutex_);
  watcher_ = std::move(watcher);
}

void RendererSet::tell_watcher() {
  const std::lock_guard lock(watcher_mutex_);
  if (watcher_) watcher_(pictures());
}

PictureCount RendererSet::pictures() const {
  PictureCount all;
  for (const WorkerRenderer* renderer : started()) {
    const PictureCount count = renderer->pictures();
    all.rendered += count.rendered;
    all.cached += count.cached;
  }
  return all;
}

std::vector<std::string> RendererSet::remarks() const {
  std::vector<std::string> all;
  for (const WorkerRenderer* renderer : started())
    for (std::string& remark : renderer->remarks()) all.push_back(std::move(remark));
  return all;
}

}  // namespace remapc
