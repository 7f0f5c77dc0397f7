#include "build/build.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <set>

#include "build/fit_folder.hpp"
#include "build/lock.hpp"
#include "build/report.hpp"
#include "emit/emit.hpp"
#include "error.hpp"
#include "files.hpp"
#include "fit/fit_table.hpp"
#include "fit/inverse_table.hpp"
#include "fit/material_network.hpp"
#include "model/chain.hpp"
#include "model/fit_json.hpp"
#include "number_text.hpp"
#include "parallel.hpp"
#include "sweep/random_sweep.hpp"
#include "version.hpp"

namespace remapc {
namespace {

namespace fs = std::filesystem;
using remap::Error;
using remap::ErrorKind;

// Empty for a file that is not there.
std::string file_sha256(const fs::path& path) {
  return fs::is_regular_file(path) ? sha256(remap::read_file(path)) : std::string();
}

struct ItemPaths {
  fs::path table, fit, header;
};
ItemPaths paths_of(const BuildFolders& folders, const std::string& id) {
  return {folders.fits / "tables" / (id + ".csv"), folders.fits / (id + ".json"),
          folders.generated / (id + ".hpp")};
}

bool has_table(const ManifestItem& item) {
  return std::holds_alternative<SweptItem>(item.kind) || std::holds_alternative<InverseItem>(item.kind) ||
         std::holds_alternative<NetworkItem>(item.kind);
}

// What an item is made from. `lock` holds its inputs as they are now.
std::string recipe_hash(const ManifestItem& item, const Lock& lock) {
  std::string text = std::string(remap::kVersion) + "\n" + std::to_string(remap::kFitFormatVersion) + "\n" +
                     item.recipe + "\n" + std::to_string(item.seed);
  for (const std::string& input : inputs_of(item)) {
    const auto found = lock.items.find(input);
    text += "\n" + (found == lock.items.end() ? std::string() : found->second.fit);
  }
  return sha256(text);
}

// Which files of an item are those that the lock knows, and were made from what it is to be made from now.
struct Freshness {
  bool table = false, fit = false, header = false;
  std::string reason;  // of the first that is not
};
Freshness freshness(const ManifestItem& item, const BuildFolders& folders, const Lock& lock) {
  const auto found = lock.items.find(item.id);
  if (found == lock.items.end()) return {false, false, false, "has not been built"};
  const LockedItem& known = found->second;
  const ItemPaths paths = paths_of(folders, item.id);
  if (known.recipe != recipe_hash(item, lock))
    return {false, false, false, "its recipe or what it is made from has changed"};
  const auto same = [](const fs::path& path, const std::string& hash) {
    return !hash.empty() && file_sha256(path) == hash;
  };
  const auto reason = [](const fs::path& path) {
    return path.string() + (fs::exists(path) ? " is not the file that the last build made" : " is missing");
  };
  if (has_table(item) && !same(paths.table, known.table)) return {false, false, false, reason(paths.table)};
  if (!same(paths.fit, known.fit)) return {true, false, false, reason(paths.fit)};
  if (!same(paths.header, known.header)) return {true, true, false, reason(paths.header)};
  return {true, true, true, ""};
}

// What the report of a folder is made from: its fits, and the bounds that the lock knows.
std::string report_hash(const BuildFolders& folders, const Lock& lock) {
  std::set<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folders.fits))
    if (entry.path().extension() == ".json" && entry.path().filename() != kManifestName)
      paths.insert(entry.path());
  std::string text = remap::kVersion;
  for (const fs::path& path : paths) text += "\n" + path.filename().string() + " " + file_sha256(path);
  for (const auto& [id, item] : lock.items)
    text += "\n" + id + " " + remap::number_text(item.alpha_bound) + " " +
            remap::number_text(item.specular_bound);
  return sha256(text);
}

bool has_report(const BuildFolders& folders, const Lock& lock) {
  return lock.report == report_hash(folders, lock) && fs::exists(folders.fits / kReportName) &&
         fs::exists(folders.fits / kPlotName);
}

std::vector<std::string> vanished_items(const Manifest& manifest, const BuildFolders& folders,
                                        const Lock& lock) {
  std::set<std::string> ids;
  for (const ManifestItem& item : manifest.items) ids.insert(item.id);
  std::vector<std::string> vanished;
  for (const auto& [id, item] : lock.items)
    if (!ids.contains(id) && fs::exists(paths_of(folders, id).fit)) vanished.push_back(id);
  return vanished;
}

// Whether the file of converters has one for each fit of the folder.
bool lists(const fs::path& path, const FitFolder& folder) {
  if (!fs::is_regular_file(path)) return false;
  const auto listed = remap::converters_from_json(remap::read_file(path), path.string());
  return std::equal(
      listed.begin(), listed.end(), folder.fits.begin(), folder.fits.end(),
      [](const remap::ConverterData& data, const remap::Fit& fit) { return data.id == fit.id; });
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
    for (const ManifestItem& item : manifest_.items) waiting.push_back(&item);
    while (!waiting.empty()) {
      // Those whose inputs do not wait; the order of a manifest lets there be some.
      std::vector<const ManifestItem*> ready, later;
      for (const ManifestItem* item : waiting) {
        const std::vector<std::string> inputs = inputs_of(*item);
        const bool waits = std::any_of(inputs.begin(), inputs.end(), [&](const std::string& input) {
          return std::any_of(waiting.begin(), waiting.end(),
                             [&](const ManifestItem* other) { return other->id == input; });
        });
        (waits ? later : ready).push_back(item);
      }
      remap::run_parallel(ready.size(), execution_.jobs, [&](std::size_t i) { build_item(*ready[i]); });
      waiting = later;
    }
    const FitFolder folder = load_fit_folder(folders_.fits);
    write_converters(folder);
    write_report(folder);
    if (lock_ != load_lock(folders_.fits)) save_lock(folders_.fits, lock_);
    std::sort(built_.begin(), built_.end(),
              [](const BuiltItem& a, const BuiltItem& b) { return a.id < b.id; });
    return {std::move(built_), std::move(pruned_)};
  }

 private:
  // Items that the manifest no longer has: those whose fits are still there are remembered, so that a later
  // build can remove them.
  void forget_vanished() {
    std::set<std::string> kept;
    for (const ManifestItem& item : manifest_.items) kept.insert(item.id);
    for (const std::string& id : vanished_items(manifest_, folders_, last_lock_)) {
      if (execution_.prune && prune(id))
        pruned_.push_back(id);
      else
        kept.insert(id);
    }
    std::erase_if(lock_.items, [&](const auto& entry) { return !kept.contains(entry.first); });
  }

  // Whether all files of a vanished item were as a build left them; they are gone then.
  bool prune(const std::string& id) const {
    const LockedItem& known = last_lock_.items.at(id);
    const ItemPaths paths = paths_of(folders_, id);
    const std::vector<std::pair<fs::path, std::string>> files = {
        {paths.table, known.table}, {paths.fit, known.fit}, {paths.header, known.header}};
    for (const auto& [path, hash] : files)
      if (fs::exists(path) && file_sha256(path) != hash) return false;
    for (const auto& [path, hash] : files) fs::remove(path);
    return true;
  }

  void build_item(const ManifestItem& item) {
    require_time();
    const auto start = std::chrono::steady_clock::now();
    LockedItem record;
    Freshness fresh;
    {
      const std::lock_guard lock(mutex_);
      fresh = freshness(item, folders_, lock_);
      record = lock_.items[item.id];
      record.recipe = recipe_hash(item, lock_);
    }
    std::string kept_table;
    try {
      if (!fresh.table && keeps_table(item, &record, &kept_table)) fresh.table = true;
      make(item, fresh, &record);
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::kInterrupted) throw;
      throw Error(error.kind(), item.id + ": " + error.what());
    }
    const std::lock_guard lock(mutex_);
    lock_.items[item.id] = record;
    if (!fresh.header) {
      save_lock(folders_.fits, lock_);
      built_.push_back({item.id, !fresh.table && has_table(item), !fresh.fit, true,
                        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
                        kept_table});
    }
    ++done_;
    if (execution_.progress) execution_.progress(done_, manifest_.items.size());
  }

  // Whether the table of the last build serves again, since a renderer that would make it anew is not here.
  bool keeps_table(const ManifestItem& item, LockedItem* record, std::string* reason) const {
    const auto* swept = std::get_if<SweptItem>(&item.kind);
    const auto last = last_lock_.items.find(item.id);
    if (swept == nullptr || last == last_lock_.items.end() || last->second.recipe != record->recipe ||
        file_sha256(paths_of(folders_, item.id).table) != last->second.table)
      return false;
    try {
      find_model(renderer_, swept->source);
      find_model(renderer_, swept->target);
      return false;
    } catch (const Error& error) {
      *reason = error.what();
      record->table = last->second.table;
      return true;
    }
  }

  void make(const ManifestItem& item, const Freshness& fresh, LockedItem* record) const {
    const ItemPaths paths = paths_of(folders_, item.id);
    if (has_table(item) && !fresh.table) {
      const auto* network = std::get_if<NetworkItem>(&item.kind);
      const std::string text =
          network != nullptr ? named_table_text(samples_of(*network, item.seed)) : table_text(table_of(item));
      remap::write_file(paths.table, text);
      record->table = sha256(text);
    }
    if (!fresh.fit) {
      const std::string text =
          std::visit([](const auto& fit) { return fit_to_json(fit); }, fit_of(item, paths));
      remap::write_file(paths.fit, text);
      record->fit = sha256(text);
    }
    if (fresh.header) return;
    const std::string text =
        std::visit([&](const auto& fit) { return header_of(fit, record); }, remap::load_any_fit(paths.fit));
    remap::write_file(paths.header, text);
    record->header = sha256(text);
  }

  static std::string header_of(const remap::Fit& fit, LockedItem* record) {
    const remap::Lowered lowered = remap::lower(fit.mapping, fit.domain);
    record->alpha_bound = lowered.alpha.bound;
    record->specular_bound = lowered.specular.bound;
    return emit_lowered_header(fit, lowered);
  }
  static std::string header_of(const remap::AnalyticFit& fit, LockedItem*) { return emit_header(fit); }
  static std::string header_of(const remap::WarpMapFit& fit, LockedItem*) { return emit_header(fit); }

  Table table_of(const ManifestItem& item) const {
    if (const auto* inverse = std::get_if<InverseItem>(&item.kind)) {
      const std::string bytes = remap::read_file(paths_of(folders_, inverse->of).fit);
      return inverse_table(remap::fit_from_json(bytes, inverse->of), bytes);
    }
    const auto& [source, target, recipe] = std::get<SweptItem>(item.kind);
    SweepOptions options;
    options.source = source;
    options.target = target;
    options.objective = objective_preset(recipe.objective);
    options.objective_name = recipe.objective;
    options.resolution = recipe.resolution;
    remap::Range speculars = canonical_speculars(renderer_, find_model(renderer_, source));
    if (const auto part = recipe.speculars.find(source); part != recipe.speculars.end())
      speculars = {std::max(speculars.min, part->second.min), std::min(speculars.max, part->second.max)};
    options.samples =
        grid_samples(recipe.alphas, recipe.roughness_samples, speculars, recipe.specular_samples);
    options.sampling = grid_text(recipe.alphas, recipe.roughness_samples, speculars, recipe.specular_samples);
    return run_sweep(renderer_, options, {1, {}, execution_.cancelled});
  }

  remap::AnyFit fit_of(const ManifestItem& item, const ItemPaths& paths) const {
    if (const auto* analytic = std::get_if<AnalyticItem>(&item.kind)) return analytic->fit;
    if (const auto* published = std::get_if<PublishedItem>(&item.kind)) return published->fit;
    if (const auto* chain = std::get_if<ChainItem>(&item.kind)) return chain_of(*chain, item.id);
    if (const auto* network = std::get_if<NetworkItem>(&item.kind)) return network_of(*network, item, paths);
    const std::string bytes = remap::read_file(paths.table);
    FitOptions options;
    options.id = item.id;
    options.regression.seed = item.seed;
    options.regression.jobs = 1;
    return fit_table(parse_table(bytes, paths.table.string()), bytes, options,
                     [&](double) { require_time(); })
        .fit;
  }

  NamedTable samples_of(const NetworkItem& item, std::uint64_t seed) const {
    RandomSweepOptions options;
    options.source = item.metallic;
    options.target = item.specular;
    options.source_casting.fixed = item.fixed;
    options.objective = objective_preset("natural");
    options.objective_name = "natural";
    options.resolution = item.resolution;
    options.count = item.count;
    options.seed = seed;
    options.varied = item.varied;
    return run_random_sweep(renderer_, options, {1, {}, execution_.cancelled});
  }

  // The item says what the ends mean; F0 must be that of the samples.
  remap::AnalyticFit network_of(const NetworkItem& network, const ManifestItem& item,
                                const ItemPaths& paths) const {
    const std::string bytes = remap::read_file(paths.table);
    MaterialNetworkOptions options;
    options.id = item.id;
    options.hidden = network.hidden;
    options.activation = network.activation;
    options.seed = item.seed;
    options.jobs = 1;
    remap::AnalyticFit fit = fit_material_network(parse_named_table(bytes, paths.table.string()), bytes,
                                                  options, [&](double) { require_time(); });
    const double own = network.fit.conversion.metallic.dielectric_f0,
                 sampled = fit.conversion.metallic.dielectric_f0;
    if (std::fabs(own - sampled) > 1e-4)
      throw Error(ErrorKind::kInput, "F0 of a dielectric is " + remap::number_text(sampled) +
                                         " in the samples; expected " + remap::number_text(own));
    fit.conversion.specular = network.fit.conversion.specular;
    fit.conversion.metallic = network.fit.conversion.metallic;
    fit.remarks = network.fit.remarks;
    return fit;
  }

  void require_time() const {
    if (execution_.cancelled != nullptr && *execution_.cancelled)
      throw Error(ErrorKind::kInterrupted, "build: interrupted; what is finished is kept, run it again");
  }

  remap::Fit chain_of(const ChainItem& chain, const std::string& id) const {
    std::vector<remap::Fit> steps;
    for (const std::string& step : chain.steps)
      steps.push_back(remap::load_fit(paths_of(folders_, step).fit));
    return composed_fit(steps, id);
  }

  void write_converters(const FitFolder& folder) const {
    // Warps are made from textures and strokes, so no item of a manifest is one.
    for (const remap::WarpMapFit& fit : folder.warps)
      write_changed(paths_of(folders_, fit.id).header, emit_header(fit));
    const fs::path path = folders_.generated / kConverterListName;
    if (built_.empty() && lists(path, folder)) return;
    std::vector<remap::ConverterData> converters;
    for (const remap::Fit& fit : folder.fits)
      converters.push_back(remap::converter_data(fit, remap::lower(fit.mapping, fit.domain)));
    write_changed(path, emit_converter_list(std::move(converters)));
  }

  // Which takes a second to compute.
  void write_report(const FitFolder& folder) {
    if (has_report(folders_, lock_)) return;
    for (const ReportFile& file : report(folder, lock_)) write_changed(folders_.fits / file.name, file.text);
    lock_.report = report_hash(folders_, lock_);
  }

  static void write_changed(const fs::path& path, const std::string& text) {
    if (!fs::exists(path) || remap::read_file(path) != text) remap::write_file(path, text);
  }

  const Renderer& renderer_;
  const Manifest& manifest_;
  const BuildFolders& folders_;
  const BuildExecution& execution_;
  const Lock last_lock_;  // of the build before
  Lock lock_;
  std::mutex mutex_;
  std::size_t done_ = 0;
  std::vector<BuiltItem> built_;
  std::vector<std::string> pruned_;
};

}  // namespace

BuildResult build(const Renderer& renderer, const Manifest& manifest, const BuildFolders& folders,
                  const BuildExecution& execution) {
  return Builder(renderer, manifest, folders, execution).run();
}

remap::Fit composed_fit(const std::vector<remap::Fit>& steps, const std::string& id) {
  remap::Fit chain = remap::compose(steps, id);
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
  for (const ManifestItem& item : manifest.items) {
    const Freshness fresh = freshness(item, folders, lock);
    if (!fresh.header) reasons.push_back(item.id + ": " + fresh.reason);
  }
  for (const std::string& id : vanished_items(manifest, folders, lock))
    reasons.push_back(id + ": is no item of the manifest; `remapc build --prune` removes its files");
  if (!has_report(folders, lock))
    reasons.push_back((folders.fits / kReportName).string() + ": is not the report of these fits");
  const FitFolder folder = load_fit_folder(folders.fits);
  if (const fs::path list = folders.generated / kConverterListName; !lists(list, folder))
    reasons.push_back(list.string() + ": does not list the converters of these fits");
  for (const remap::WarpMapFit& fit : folder.warps) {
    const fs::path header = paths_of(folders, fit.id).header;
    if (!fs::exists(header) || remap::read_file(header) != emit_header(fit))
      reasons.push_back(fit.id + ": " + header.string() + " is not what its fit gives");
  }
  for (const remap::Fit& fit : folder.fits) {
    const fs::path table = folders.fits / "tables" / fit.table.name;
    if (fit.table.name.empty() || !fs::exists(table) || file_sha256(table) == fit.table.sha256) continue;
    reasons.push_back(fit.id + ": " + table.string() + " is not the table that it was fitted to");
  }
  return reasons;
}

}  // namespace remapc
