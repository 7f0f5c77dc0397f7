#include "texremap/plan/job.hpp"

#include <algorithm>

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
    if (const fs::path folder = folder_of_asset(asset.copy_of(file));
        std::ranges::find(folders, folder) == folders.end())
      folders.push_back(folder);
  return folders;
}

}  // namespace remap
