#include "build/build.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <set>

#include "build/fit_folder.hpp"
#include "build/freshness.hpp"
#include "build/report.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/number_text.hpp"
#include "core/parallel.hpp"
#include "core/system.hpp"
#include "emit/emit.hpp"
#include "fit/fit_table.hpp"
#include "fit/network/fit_network.hpp"
#include "lower/chain.hpp"
#include "lower/fit_file.hpp"
#include "lower/lower.hpp"
#include "measure/sweep.hpp"
#include "remap/error.hpp"
#include "renderer/renderer.hpp"
#include "table/table.hpp"

namespace remap {
namespace {

namespace fs = std::filesystem;

bool holds(const fs::path& path, const std::string& text) {
  return fs::exists(path) && read_file(path) == text;
}

void write_changed(const fs::path& path, const std::string& text) {
  if (!holds(path, text)) write_file(path, text);
}

class Builder {
 public:
  Builder(const Renderer& renderer, const Manifest& manifest, const BuildFolders& folders,
          const BuildExecution& execution)
      : renderer_(renderer),
        manifest_(manifest),
        folders_(folders),
        execution_(execution),
        last_lock_(load_lock(folders.fits)),
        lock_(execution.force ? Lock{} : last_lock_) {}

  BuildResult run() {
    forget_vanished();
    std::vector<const ManifestItem*> waiting;
    for (const ManifestItem& item : manifest_) waiting.push_back(&item);
    while (!waiting.empty()) {
      // Start with the items whose inputs exist already. Because of the order of a manifest, there are some.
      std::vector<const ManifestItem*> ready, later;
      for (const ManifestItem* item : waiting) {
        const std::vector<std::string> inputs = inputs_of(*item);
        const bool waits = std::ranges::any_of(inputs, [&](const std::string& input) {
          return std::ranges::any_of(waiting, [&](const ManifestItem* other) { return other->id == input; });
        });
        const auto lost =
            std::ranges::find_if(inputs, [&](const auto& input) { return failures_.contains(input); });
        if (lost == inputs.end())
          (waits ? later : ready).push_back(item);
        else
          failures_.emplace(item->id, Error(failures_.at(*lost).kind(), "needs " + *lost));
      }
      run_parallel(ready.size(), execution_.jobs, [&](std::size_t i) { build_item(*ready[i]); });
      waiting = later;
    }
    std::ranges::sort(built_, {}, &BuiltItem::id);
    BuildResult result{std::move(built_), std::move(failures_), std::move(pruned_)};
    if (!result.failed.empty()) return result;
    const FitFolder folder = load_fit_folder(folders_.fits);
    write_converters(folder);
    write_report(folder);
    if (lock_ != load_lock(folders_.fits)) save_lock(folders_.fits, lock_);
    return result;
  }

 private:
  // Removes vanished items from the lock. If the fit of an item still exists, the item stays in the lock, so
  // that a later build can delete the fit.
  void forget_vanished() {
    std::set<std::string> kept;
    for (const ManifestItem& item : manifest_) kept.insert(item.id);
    for (const std::string& id : vanished_items(manifest_, folders_, last_lock_)) {
      if (execution_.prune && prune(id))
        pruned_.push_back(id);
      else
        kept.insert(id);
    }
    std::erase_if(lock_.items, [&](const auto& entry) { return !kept.contains(entry.first); });
  }

  // Deletes the files of a vanished item and returns true. If a file changed after the build, deletes
  // nothing.
  bool prune(const std::string& id) const {
    const LockedItem& known = last_lock_.items.at(id);
    const std::vector<std::pair<fs::path, std::string>> files = {{folders_.table(id), known.table},
                                                                 {folders_.fit(id), known.fit},
                                                                 {folders_.header(id), known.header}};
    for (const auto& [path, hash] : files)
      if (fs::exists(path) && file_sha256(path) != hash) return false;
    for (const auto& [path, hash] : files) fs::remove(path);
    return true;
  }

  void build_item(const ManifestItem& item) {
    require_time();
    BuiltItem built;
    LockedItem record;
    Freshness fresh = Freshness::kNothing;
    {
      const std::lock_guard lock(mutex_);
      fresh = freshness(item, folders_, lock_);
      record = lock_.items[item.id];
      record.recipe = recipe_hash(item, lock_);
    }
    try {
      const Stopwatch stopwatch;
      if (fresh == Freshness::kNothing && keeps_table(item, &record, &built.kept_table))
        fresh = Freshness::kTable;
      make(item, fresh, &record, &built);
      built.seconds = stopwatch.seconds();
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::kInterrupted) throw;
      const std::lock_guard lock(mutex_);
      failures_.emplace(item.id, error);
      return;
    }
    const std::lock_guard lock(mutex_);
    lock_.items[item.id] = record;
    if (fresh != Freshness::kAll) {
      save_lock(folders_.fits, lock_);
      built.id = item.id;
      built.table = fresh == Freshness::kNothing && has_table(item);
      built.fit = fresh < Freshness::kFit;
      built.header = true;
      built_.push_back(std::move(built));
    }
    ++done_;
    if (execution_.progress) execution_.progress(done_, manifest_.size());
  }

  // Returns true if the table of the last build can be used again because its renderer is not installed.
  bool keeps_table(const ManifestItem& item, LockedItem* record, std::string* reason) const {
    const auto* swept = std::get_if<SweptItem>(&item.kind);
    const auto last = last_lock_.items.find(item.id);
    if (swept == nullptr || last == last_lock_.items.end() || last->second.recipe != record->recipe ||
        file_sha256(folders_.table(item.id)) != last->second.table)
      return false;
    try {
      renderer_.model(swept->source);
      renderer_.model(swept->target);
      return false;
    } catch (const Error& error) {
      *reason = error.what();
      record->table = last->second.table;
      return true;
    }
  }

  void make(const ManifestItem& item, Freshness fresh, LockedItem* record, BuiltItem* built) {
    const fs::path table = folders_.table(item.id), fit_path = folders_.fit(item.id);
    if (has_table(item) && fresh == Freshness::kNothing) {
      const std::string text = table_text(table_of(item, built));
      write_file(table, text);
      record->table = sha256(text);
    }
    if (fresh == Freshness::kAll) return;
    const bool is_fitted = fresh == Freshness::kFit;
    AnyFit fit = is_fitted ? load_any_fit(fit_path) : fit_of(item, table, built);
    if (!is_fitted) {
      if (auto* of_width = std::get_if<Fit>(&fit)) {
        const Stopwatch stopwatch;
        add_converter(of_width);
        built->lowering_seconds = stopwatch.seconds();
      }
      const std::string text = std::visit([](const auto& made) { return fit_to_json(made); }, fit);
      write_file(fit_path, text);
      record->fit = sha256(text);
    }
    const std::string text = std::visit([](const auto& made) { return emit_header(made); }, fit);
    write_file(folders_.header(item.id), text);
    record->header = sha256(text);
  }

  // Calls `made` with a renderer that counts pictures.
  template <class Make>
  auto with_pictures(BuiltItem* built, const Make& made) const {
    const TimedRenderer renderer(renderer_);
    const Stopwatch stopwatch;
    auto result = made(renderer);
    built->sweep_seconds = stopwatch.seconds();
    built->pictures = renderer.picture_count();
    built->picture_seconds = renderer.seconds();
    return result;
  }

  Table table_of(const ManifestItem& item, BuiltItem* built) const {
    if (const auto* derived = std::get_if<DerivedItem>(&item.kind)) {
      const std::string& of = derived->inputs.front();
      const std::string bytes = read_file(folders_.fit(of));
      return inverse_table(fit_from_json(bytes, of), bytes);
    }
    const auto& swept = std::get<SweptItem>(item.kind);
    SweepOptions options;
    options.source = swept.source;
    options.target = swept.target;
    options.objective = swept.objective;
    options.accept_light = item.accept_light;
    options.resolution = swept.resolution;
    Range speculars = canonical_speculars(renderer_, renderer_.model(swept.source));
    if (const auto part = swept.speculars.find(swept.source); part != swept.speculars.end())
      speculars = {std::max(speculars.min, part->second.min), std::min(speculars.max, part->second.max)};
    options.samples = grid_samples(swept.alphas, swept.roughness_samples, speculars, swept.specular_samples);
    options.sampling = grid_text(swept.alphas, swept.roughness_samples, speculars, swept.specular_samples);
    return with_pictures(built, [&](const Renderer& renderer) {
      return run_sweep(renderer, options, {1, {}, execution_.cancelled});
    });
  }

  AnyFit fit_of(const ManifestItem& item, const fs::path& table, BuiltItem* built) const {
    if (const auto* finished = std::get_if<AnyFit>(&item.kind)) return *finished;
    if (const auto* derived = std::get_if<DerivedItem>(&item.kind);
        derived != nullptr && !derived->is_inverse())
      return chain_of(*derived, item.id);
    if (const auto* network = std::get_if<NetworkItem>(&item.kind)) return network_of(*network, item, built);
    const Stopwatch stopwatch;
    const std::string bytes = read_file(table);
    FitOptions options;
    options.id = item.id;
    options.seed = item.seed;
    options.jobs = 1;
    options.accept_light = item.accept_light;
    Fit fit = fit_table(parse_table(bytes, table.string()), bytes, options, [&](double) { require_time(); });
    built->fit_seconds = stopwatch.seconds();
    return fit;
  }

  MaterialTable samples_of(const NetworkItem& item, std::uint64_t seed, BuiltItem* built) const {
    MaterialSampleOptions options;
    options.source = item.metallic;
    options.target = item.specular;
    options.source_roles.fixed = item.fixed;
    options.objective = recorded_objective("natural");  // a manifest cannot choose the objective of samples.
    options.resolution = item.resolution;
    options.count = item.count;
    options.seed = seed;
    options.varied = item.varied;
    return with_pictures(built, [&](const Renderer& renderer) {
      return run_material_sample(renderer, options, {execution_.jobs, {}, execution_.cancelled});
    });
  }

  // Trains a network. The item defines the workflows of both ends, and the samples must have the same F0 of
  // dielectrics. The build does not keep the samples, because they are megabytes, and `remapc sample` can
  // make them again. It only stores their hash in the fit.
  WorkflowFit network_of(const NetworkItem& network, const ManifestItem& item, BuiltItem* built) const {
    const std::string bytes = material_table_text(samples_of(network, item.seed, built));
    const Stopwatch stopwatch;
    MaterialNetworkOptions options;
    options.id = item.id;
    options.hidden = network.hidden;
    options.activation = network.activation;
    options.seed = item.seed;
    options.jobs = 1;
    WorkflowFit fit = fit_material_network(parse_material_table(bytes, item.id + ".csv"), bytes, options,
                                           [&](double) { require_time(); });
    built->fit_seconds = stopwatch.seconds();
    const double own = network.fit.conversion.metallic.dielectric_f0,
                 sampled = fit.conversion.metallic.dielectric_f0;
    if (std::fabs(own - sampled) > 1e-4)
      throw input_error("dielectric F0 is " + number_text(sampled) + " in the samples and " +
                        number_text(own) + " in the manifest");
    fit.conversion.specular = network.fit.conversion.specular;
    fit.conversion.metallic = network.fit.conversion.metallic;
    fit.remarks = network.fit.remarks;
    return fit;
  }

  void require_time() const {
    if (execution_.cancelled != nullptr && *execution_.cancelled)
      throw Error(ErrorKind::kInterrupted,
                  "build: interrupted (finished items are kept; run the same command again to continue)");
  }

  Fit chain_of(const DerivedItem& chain, const std::string& id) const {
    std::vector<Fit> steps;
    for (const std::string& step : chain.inputs) steps.push_back(load_fit(folders_.fit(step)));
    return composed_fit(steps, id);
  }

  void write_converters(const FitFolder& folder) {
    // A manifest never lists warps, because they are made from textures and strokes.
    for (const WarpMapFit& fit : folder.warps) write_changed(folders_.header(fit.id), emit_header(fit));
    for (const EmittedFile& file : emit_shared_files(folder.fits))
      write_changed(folders_.generated / file.name, file.text);
  }

  // The report takes a second to compute, so it is written only if its fits changed.
  void write_report(const FitFolder& folder) {
    if (has_report(folders_, lock_)) return;
    for (const EmittedFile& file : report(folder)) write_changed(folders_.fits / file.name, file.text);
    lock_.report = report_hash(folders_);
  }

  const Renderer& renderer_;
  const Manifest& manifest_;
  const BuildFolders& folders_;
  const BuildExecution& execution_;
  const Lock last_lock_;  // the lock of the previous build
  Lock lock_;
  std::mutex mutex_;
  std::size_t done_ = 0;
  std::vector<BuiltItem> built_;
  std::map<std::string, Error> failures_;  // keyed by id
  std::vector<std::string> pruned_;
};

}  // namespace

BuildResult build(const Renderer& renderer, const Manifest& manifest, const BuildFolders& folders,
                  const BuildExecution& execution) {
  return Builder(renderer, manifest, folders, execution).run();
}

Fit composed_fit(const std::vector<Fit>& steps, const std::string& id) {
  Fit chain = compose(steps, id);
  for (std::size_t i = 0; i < steps.size(); ++i)
    chain.table.comments["step " + std::to_string(i + 1)] =
        steps[i].id + ", sha256 " + sha256(fit_to_json(steps[i]));
  return chain;
}

std::vector<std::string> vanished_items(const Manifest& manifest, const BuildFolders& folders) {
  return vanished_items(manifest, folders, load_lock(folders.fits));
}

std::vector<std::string> stale(const Manifest& manifest, const BuildFolders& folders) {
  const Lock lock = load_lock(folders.fits);
  std::vector<std::string> reasons;
  for (const ManifestItem& item : manifest) {
    std::string reason;
    if (freshness(item, folders, lock, &reason) != Freshness::kAll)
      reasons.push_back(item.id + ": " + reason);
  }
  for (const std::string& id : vanished_items(manifest, folders, lock))
    reasons.push_back(id + ": no longer in the manifest (`remapc build --prune` removes its files)");
  if (!has_report(folders, lock))
    reasons.push_back((folders.fits / kReportName).string() + ": out of date with the fits of the folder");
  const FitFolder folder = load_fit_folder(folders.fits);
  for (const EmittedFile& file : emit_shared_files(folder.fits))
    if (!holds(folders.generated / file.name, file.text))
      reasons.push_back((folders.generated / file.name).string() + ": is out of date with the fits");
  for (const WarpMapFit& fit : folder.warps) {
    const fs::path header = folders.header(fit.id);
    if (!holds(header, emit_header(fit)))
      reasons.push_back(fit.id + ": " + header.string() + " is out of date with its fit");
  }
  for (const Fit& fit : folder.fits) {
    const fs::path table = folders.fits / "tables" / fit.table.name;
    if (fit.table.name.empty() || !fs::exists(table) || file_sha256(table) == fit.table.sha256) continue;
    reasons.push_back(fit.id + ": " + table.string() + " was changed after the fit");
  }
  return reasons;
}

}  // namespace remap
