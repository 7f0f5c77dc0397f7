// This file stores the hashes of a build. From these, the next build decides what is up to date.
#pragma once

#include <filesystem>
#include <map>
#include <string>

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

}  // namespace remap
