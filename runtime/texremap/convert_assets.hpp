// `texremap convert` of assets: a file in, the same file with converted materials out.
#pragma once

#include <optional>

#include "texremap/convert_options.hpp"
#include "texremap/manifest.hpp"

namespace remap {

// What people type for assets: a second path in place of --output (`convert in.glb out.glb`), and no target,
// or a word for metallic and roughness, in place of `--to gltf`.
ConvertOptions meaning_assets(ConvertOptions options);

// Whether the options name assets: as a manifest of them, a folder or files. Where they do not, throws kUsage
// for options that only assets have.
bool are_assets(const ConvertOptions& options, const std::optional<TreeManifest>& manifest);

// Converts them. Throws as the conversion of sets does: after the last file, where one failed.
void convert_assets(const ConvertOptions& options, const std::optional<TreeManifest>& manifest);

// All that convert_assets() checks before it opens the first asset.
void check_assets(const ConvertOptions& options, const std::optional<TreeManifest>& manifest);

}  // namespace remap
