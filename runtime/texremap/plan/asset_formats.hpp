// This file maps extensions of assets to formats: which code reads each, and what each may become. It
// also checks the input paths of a user, and suggests what to do about files that texremap cannot read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "assets/document/asset.hpp"

namespace remap {

bool is_asset_name(const std::filesystem::path& path);
bool is_obj_name(const std::filesystem::path& path);
// Returns true if the file is glTF, to which most options of assets apply.
bool is_gltf_name(const std::filesystem::path& path);

// Returns the extensions, without dot, of the assets that a run converts in a folder. If `format` is given,
// these are OBJ files. Otherwise, these are the files that keep their format.
std::vector<std::string> asset_extensions(const std::string& format);
// Returns the formats of such assets as text, for example `glTF or MTL file`.
std::string asset_words(const std::string& format);

// Returns the extension of the result, with its dot, or an empty text if the input's extension stays. Throws
// kUsage if the input cannot become `format`.
std::string result_extension(const std::filesystem::path& input, const std::string& format);
// Throws kUsage if `input` cannot become a file of the kind of `output`.
void require_format(const std::filesystem::path& input, const std::filesystem::path& output);

// Returns the files that an asset names. Throws kInput.
std::vector<AssetResource> resources_of_asset(const ByteSource& source, const std::filesystem::path& input,
                                              const AssetResources& resources);

// Converts `source`, the content of `input`. Throws kInput and kOutput, with the path.
AssetConversion convert_asset(const ByteSource& source, const std::filesystem::path& input,
                              const std::filesystem::path& output, const AssetOptions& options,
                              const AssetResources& resources);

// Throws kUsage, with the format and the advice, for a file of a format that other tools use.
void require_readable(const std::filesystem::path& path);

// Throws kUsage for paths that are neither one folder nor only assets.
void require_one_kind(const std::filesystem::path& first, const std::vector<std::filesystem::path>& more);

}  // namespace remap
