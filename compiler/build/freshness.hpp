// This file decides which files of a build are up to date, from the hashes that the last build stored.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "build/manifest.hpp"

namespace remap {

inline constexpr const char* kLockName = "manifest.lock";

// A LockedItem holds the SHA-256 of an item's inputs and results. They are empty if there are none.
struct LockedItem {
  std::string recipe;  // hash of its recipe, the version of remapc and the fits that it is made from
  std::string table;
  std::string fit;
  std::string header;
  bool operator==(const LockedItem&) const = default;
};

struct Lock {
  std::map<std::string, LockedItem> items;  // keyed by id
  std::string report;                       // hash of all fits in the folder, from which the report is made
  bool operator==(const Lock&) const = default;
};

// Returns an empty lock if the folder has no lock, or a lock of an unknown version. Everything is then made
// again.
Lock load_lock(const std::filesystem::path& fit_folder);
void save_lock(const std::filesystem::path& fit_folder, const Lock& lock);

struct BuildFolders {
  std::filesystem::path fits = "fits";  // fits, with tables/ in it; README.md there is the report
  std::filesystem::path generated = "generated";

  // Return the files of an item.
  std::filesystem::path table(const std::string& id) const { return fits / "tables" / (id + ".csv"); }
  std::filesystem::path fit(const std::string& id) const { return fits / (id + ".json"); }
  std::filesystem::path header(const std::string& id) const { return generated / (id + ".hpp"); }
};

// Returns true if items of this kind keep a table. A network keeps only its fit.
bool has_table(const ManifestItem& item);

// Returns a hash of what an item is made from. `lock` has the current state of its inputs.
std::string recipe_hash(const ManifestItem& item, const Lock& lock);

// A Freshness states which files of an item are in the lock and still match their inputs. A file is fresh
// only if the files before it are fresh.
enum class Freshness { kNothing, kTable, kFit, kAll };

// `reason` receives why the first stale file is not fresh.
Freshness freshness(const ManifestItem& item, const BuildFolders& folders, const Lock& lock,
                    std::string* reason = nullptr);

// Returns a hash of the fits of a folder, from which its report is made.
std::string report_hash(const BuildFolders& folders);

// Returns true if the files of the report exist and were made from the fits of the folder.
bool has_report(const BuildFolders& folders, const Lock& lock);

// Returns the items of `lock` that are no longer in the manifest, but whose fits still exist. Returns ids.
std::vector<std::string> vanished_items(const Manifest& manifest, const BuildFolders& folders,
                                        const Lock& lock);

}  // namespace remap
