#include "build/freshness.hpp"

#include <set>

#include "build/fit_folder.hpp"
#include "build/report.hpp"
#include "converter/converter_data.hpp"
#include "core/files.hpp"
#include "core/json_field.hpp"
#include "remap/error.hpp"
#include "remap/version.hpp"
#include "table/table.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

constexpr int kLockVersion = 1;

LockedItem read_item(const Field& field) {
  return {field["recipe"].text(), field["table"].text(), field["fit"].text(), field["header"].text()};
}

}  // namespace

Lock load_lock(const std::filesystem::path& fit_folder) {
  const std::filesystem::path path = fit_folder / kLockName;
  if (!std::filesystem::exists(path)) return {};
  try {
    const Json json = parse_json(read_file(path), path.string());
    const Field root(json, path.string());
    if (root["version"].count() != kLockVersion) return {};
    Lock lock;
    lock.items = root["items"].dictionary<LockedItem>(read_item);
    if (root.contains("report")) lock.report = root["report"].text();
    return lock;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    return {};
  }
}

void save_lock(const std::filesystem::path& fit_folder, const Lock& lock) {
  Json items = Json::object();
  for (const auto& [id, item] : lock.items)
    items[id] = {{"recipe", item.recipe}, {"table", item.table}, {"fit", item.fit}, {"header", item.header}};
  const Json json = {
      {"format", "remap-lock"}, {"version", kLockVersion}, {"report", lock.report}, {"items", items}};
  write_file(fit_folder / kLockName, json.dump(1) + "\n");
}

bool has_table(const ManifestItem& item) {
  const auto* derived = std::get_if<DerivedItem>(&item.kind);
  return std::holds_alternative<SweptItem>(item.kind) || (derived != nullptr && derived->is_inverse());
}

namespace {

// Increase this number if every table must be swept again. The format of fits has another number.
constexpr int kTableVersion = 3;

bool has_current_format(const fs::path& fit) {
  const std::string version = "\"version\": " + std::to_string(kFitFormatVersion) + ",";
  return read_file(fit).substr(0, 100).find(version) != std::string::npos;
}

}  // namespace

std::string recipe_hash(const ManifestItem& item, const Lock& lock) {
  std::string text = std::string(kVersion) + "\n" + std::to_string(kTableVersion) + "\n" + item.recipe +
                     "\n" + std::to_string(item.seed);
  for (const std::string& input : inputs_of(item)) {
    const auto found = lock.items.find(input);
    text += "\n" + (found == lock.items.end() ? std::string() : found->second.fit);
  }
  return sha256(text);
}

Freshness freshness(const ManifestItem& item, const BuildFolders& folders, const Lock& lock,
                    std::string* reason) {
  const auto stale = [&](Freshness fresh, const std::string& why) {
    if (reason != nullptr) *reason = why;
    return fresh;
  };
  const auto found = lock.items.find(item.id);
  if (found == lock.items.end()) return stale(Freshness::kNothing, "not built yet");
  const LockedItem& known = found->second;
  const fs::path table = folders.table(item.id), fit = folders.fit(item.id), header = folders.header(item.id);
  if (known.recipe != recipe_hash(item, lock))
    return stale(Freshness::kNothing, "its recipe or its inputs have changed");
  const auto same = [](const fs::path& path, const std::string& hash) {
    return !hash.empty() && file_sha256(path) == hash;
  };
  const auto change = [](const fs::path& path) {
    return path.string() + (fs::exists(path) ? " was changed after the last build" : " does not exist");
  };
  if (has_table(item) && !same(table, known.table)) return stale(Freshness::kNothing, change(table));
  if (!same(fit, known.fit)) return stale(Freshness::kTable, change(fit));
  if (!has_current_format(fit)) return stale(Freshness::kTable, fit.string() + " has an older format");
  if (!same(header, known.header)) return stale(Freshness::kFit, change(header));
  return Freshness::kAll;
}

std::string report_hash(const BuildFolders& folders) {
  std::set<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folders.fits))
    if (entry.path().extension() == ".json" && entry.path().filename() != kManifestName)
      paths.insert(entry.path());
  std::string text = kVersion + (" " + file_sha256(folders.fits / kReachName));
  for (const fs::path& path : paths) text += "\n" + path.filename().string() + " " + file_sha256(path);
  return sha256(text);
}

bool has_report(const BuildFolders& folders, const Lock& lock) {
  return lock.report == report_hash(folders) && fs::exists(folders.fits / kReportName) &&
         fs::exists(folders.fits / kFiguresName);
}

std::vector<std::string> vanished_items(const Manifest& manifest, const BuildFolders& folders,
                                        const Lock& lock) {
  std::set<std::string> ids;
  for (const ManifestItem& item : manifest) ids.insert(item.id);
  std::vector<std::string> vanished;
  for (const auto& [id, item] : lock.items)
    if (!ids.contains(id) && fs::exists(folders.fit(id))) vanished.push_back(id);
  return vanished;
}

}  // namespace remap
