#include "worker/renderer_set.hpp"

#include <algorithm>

#include "command_line/command.hpp"
#include "command_line/progress.hpp"
#include "command_line/run_app.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/json_field.hpp"
#include "core/plain_text.hpp"
#include "worker/folders.hpp"

namespace remap {
namespace {

namespace fs = std::filesystem;

bool is_name(const std::string& name) {
  return !name.empty() && name.find_first_of("/ \t") == std::string::npos;
}

WorkerEntry read_entry(const Field& field, const fs::path& folder) {
  WorkerEntry entry{field["name"].text(), field["command"].text(), folder.string(), ""};
  field["name"].require(is_name(entry.name), "a name without / and spaces");
  field["command"].require(!entry.command.empty(), "a command");
  if (field.contains("install")) entry.install = field["install"].text();
  return entry;
}

}  // namespace

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
  const std::string nearest = nearest_name(name, names);
  const std::string advice = nearest.empty()
                                 ? "`remapc list --models` shows built-in models, `remapc renderers` shows "
                                   "connected renderers; --worker \"" +
                                       name.substr(0, name.find('/')) + "=COMMAND\" connects another renderer"
                                 : "did you mean " + nearest + "?";
  throw usage_error(name + ": is not a model of " + builtin_->version() + " or of a connected renderer (" +
                    advice + ")");
}

std::vector<ModelDescription> RendererSet::models_of(const std::string& worker) const {
  std::vector<std::string> names;
  for (const WorkerEntry& entry : workers_) names.push_back(entry.name);
  if (std::ranges::find(names, worker) == names.end())
    throw usage_error(worker + ": is not a connected renderer (choose " + joined(names, ", ") + ")");
  return renderer_of(worker).models();
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
    all.lost_workers += count.lost_workers;
  }
  return all;
}

std::vector<std::string> RendererSet::remarks() const {
  std::vector<std::string> all;
  for (const WorkerRenderer* renderer : started())
    for (std::string& remark : renderer->remarks()) all.push_back(std::move(remark));
  return all;
}

std::vector<WorkerEntry> read_worker_list(const fs::path& path) {
  const auto json = parse_json(read_file(path), path.string());
  const fs::path folder = fs::absolute(path).parent_path();
  return Field(json, path.string())["workers"].list(
      0, [&](const Field& field) { return read_entry(field, folder); });
}

WorkerEntry parse_worker(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || !is_name(text.substr(0, equals)) || equals + 1 == text.size())
    throw usage_error("--worker " + text + ": is not of the form NAME=COMMAND");
  return {text.substr(0, equals), text.substr(equals + 1), fs::current_path().string(), ""};
}

std::vector<WorkerEntry> known_workers(const std::vector<std::string>& given) {
  std::map<std::string, WorkerEntry> entries;
  for (const std::string& text : given) {
    WorkerEntry entry = parse_worker(text);
    if (!entries.emplace(entry.name, entry).second)
      throw usage_error("--worker " + text + ": " + entry.name + " was given twice");
  }
  for (const fs::path& list : {own_worker_list(), shipped_worker_list()}) {
    if (!fs::exists(list)) continue;
    for (WorkerEntry& entry : read_worker_list(list)) entries.emplace(entry.name, entry);
  }
  std::vector<WorkerEntry> workers;
  for (auto& [name, entry] : entries) workers.push_back(std::move(entry));
  return workers;
}

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
