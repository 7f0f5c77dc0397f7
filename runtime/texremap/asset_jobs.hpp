// The assets that a run converts: those that the command line names, those of a folder, or those of a
// manifest.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "texremap/asset_files.hpp"
#include "texremap/convert_options.hpp"
#include "texremap/written_names.hpp"

namespace remap {

struct AssetList {
  std::vector<AssetJob> jobs;
  std::shared_ptr<WrittenNames> names = std::make_shared<WrittenNames>();  // results, inputs and copies
  std::vector<std::string> problems;  // files and folders that cannot be read
  bool is_tree = false;               // of a folder, whose results are noted in a journal
};

// Who has the names of results and new images of an asset, for WrittenNames.
std::string owner_of_results(const AssetJob& job);

// The assets on the command line.
std::vector<std::filesystem::path> named_assets(const ConvertOptions& options);

// Whether the name is that of an asset that this program reads.
bool is_asset(const std::filesystem::path& path);

// `listing`: of the manifest, if there is one. An asset that would write a file of another one has a refusal.
// Throws kUsage where a folder has none; kInput if a folder cannot be read.
AssetList asset_list(const ConvertOptions& options, const Listing* listing);

// The assets of a folder as a manifest lists them. `format`: that OBJ files are to become, or empty. Throws
// as asset_list().
Listing listing_of_assets(const std::filesystem::path& folder, const std::string& format);

}  // namespace remap
