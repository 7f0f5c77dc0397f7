// What a build left behind: the hashes by which the next one knows what is still good.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace remapc {

inline constexpr const char* kLockName = "manifest.lock";

// SHA-256 of what an item was made from and of what was made; empty: nothing. Bounds of lowering are those of
// lower/lowered.hpp, for the report.
struct LockedItem {
  std::string recipe;  // its recipe, the tool's version, and the fits that it is made from
  std::string table;
  std::string fit;
  std::string header;
  double alpha_bound = 0.0;
  double specular_bound = 0.0;
  bool operator==(const LockedItem&) const = default;
};

struct Lock {
  std::map<std::string, LockedItem> items;  // by id
  std::string report;                       // what it was made from: every fit of the folder
  bool operator==(const Lock&) const = default;
};

// An empty lock where the folder has none, or one that this version does not read: all is made anew then.
Lock load_lock(const std::filesystem::path& fit_folder);
void save_lock(const std::filesystem::path& fit_folder, const Lock& lock);

}  // namespace remapc
