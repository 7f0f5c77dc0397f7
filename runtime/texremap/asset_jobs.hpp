// The assets that a run converts: those that the command line names, those of a folder, or those of a
// manifest.
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

// `listing`: of the manifest, if there is one. Throws kUsage where two assets would become one file, or where
// a folder has none; kInput if a folder cannot be read.
AssetList asset_list(const ConvertOptions& options, const Listing* listing);

// The assets of a folder as a manifest lists them. `format`: that OBJ files are to become, or empty. Throws
// as asset_list().
Listing listing_of_assets(const std::filesystem::path& folder, const std::string& format);

}  // namespace remap
