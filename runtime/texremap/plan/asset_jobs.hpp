// This file lists the assets that a run converts: from the command line, from a folder, or from a manifest.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "texremap/options/convert_options.hpp"
#include "texremap/plan/job.hpp"

namespace remap {

// Returns the assets on the command line.
std::vector<std::filesystem::path> named_assets(const ConvertOptions& options);

// Returns true if the name belongs to an asset that this program reads.
bool is_asset(const std::filesystem::path& path);

// Returns the jobs of the assets in `listed`, the content of a manifest, or if it is null, of the assets that
// the options name. If an asset would write a file of another asset, its job gets a refusal. For assets on
// the command line, throws kUsage instead. Also throws kUsage if a folder has no assets, and kInput if the
// folder cannot be read.
JobList asset_jobs(const ConvertOptions& options, const TreeManifest* listed);

// Returns the assets of a folder as a manifest lists them. `format` is the target of OBJ files, or empty.
// Throws like asset_jobs().
TreeManifest tree_of_assets(const std::filesystem::path& folder, const std::string& format);

}  // namespace remap
