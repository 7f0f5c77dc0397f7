// The assets that a run converts: those that the command line names, or those of a folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "texremap/asset_files.hpp"
#include "texremap/convert_options.hpp"

namespace remap {

struct AssetList {
  std::vector<AssetJob> jobs;
  std::vector<std::string> problems;  // files and folders that cannot be read
  bool is_tree = false;               // of a folder, whose results are noted in a journal
};

// Whether the name is that of an asset that this program reads.
bool is_asset(const std::filesystem::path& path);

// Throws kUsage where two assets would become one file, or where a folder has none; kInput if a folder cannot
// be read.
AssetList asset_list(const ConvertOptions& options);

}  // namespace remap
