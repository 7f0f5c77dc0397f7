// The assets that a run converts: those that the command line names, those of a folder, or those of a
// manifest.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "texremap/options/convert_options.hpp"
#include "texremap/plan/job.hpp"

namespace remap {

// The assets on the command line.
std::vector<std::filesystem::path> named_assets(const ConvertOptions& options);

// Whether the name is that of an asset that this program reads.
bool is_asset(const std::filesystem::path& path);

// `listing`: of the manifest, if there is one. An asset that would write a file of another one has a refusal.
// Throws kUsage where a folder has none; kInput if a folder cannot be read.
JobList asset_jobs(const ConvertOptions& options, const Listing* listing);

// The assets of a folder as a manifest lists them. `format`: that OBJ files are to become, or empty. Throws
// as asset_list().
Listing listing_of_assets(const std::filesystem::path& folder, const std::string& format);

}  // namespace remap
