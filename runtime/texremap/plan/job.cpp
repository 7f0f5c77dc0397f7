#include "texremap/plan/job.hpp"

#include <algorithm>

#include "core/contains.hpp"
#include "core/files.hpp"
#include "core/plain_text.hpp"
#include "sets/folder_walk.hpp"

namespace remap {
namespace fs = std::filesystem;

fs::path folder_of_asset(const fs::path& asset) {
  return asset.has_parent_path() ? asset.parent_path() : fs::path(".");
}

std::vector<fs::path> Job::folders() const {
  if (const auto* set = std::get_if<SetWork>(&work)) return {set->folder, set->diagnosis_folder};
  const auto& asset = std::get<AssetWork>(work);
  std::vector<fs::path> folders = {folder_of_asset(asset.output)};
  for (const fs::path& file : asset.files)
    if (const fs::path folder = folder_of_asset(asset.copy_of(file)); !contains(folders, folder))
      folders.push_back(folder);
  return folders;
}

std::string name_key(const fs::path& path) {
  return without_case(fs::absolute(path).lexically_normal().generic_string());
}

std::string WrittenNames::take(const fs::path& path, const std::string& owner) {
  if (is_own_name(path.filename())) return "texremap itself";
  const std::string key = name_key(path);
  const std::lock_guard lock(mutex_);
  const auto [found, is_new] = owners_.try_emplace(key, owner);
  return is_new || found->second == owner ? std::string() : found->second;
}

std::string written_twice_text(const fs::path& path, const std::string& first, const std::string& second) {
  return display_path(path) + ": would be written twice, from " + first + " and from " + second +
         " (rename one, or convert them into two folders)";
}

}  // namespace remap
