// The formats of assets by the extensions of their files: what reads each, and what it may become.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "assets/document/asset.hpp"

namespace remap {

bool is_asset_name(const std::filesystem::path& path);
// Whether the file is glTF, to which most options of assets apply.
bool is_gltf_name(const std::filesystem::path& path);

// The extensions, without dot, of the assets in a folder that a run with this `--format` converts: OBJ files
// where it names what they become, else files that stay of their kind.
std::vector<std::string> asset_extensions(const std::string& format);
// The same in words, such as `glTF or MTL file`.
std::string asset_words(const std::string& format);

// The extension of the result, with its dot; empty where that of the input stays. Throws kUsage where the
// input cannot become `format`.
std::string result_extension(const std::filesystem::path& input, const std::string& format);
// Throws kUsage where `input` cannot become a file of the kind of `output`.
void require_format(const std::filesystem::path& input, const std::filesystem::path& output);

// The files that an asset names. Throws kInput.
std::vector<AssetResource> resources_of_asset(const ByteSource& source, const std::filesystem::path& input,
                                              const AssetResources& resources);

// `source` is the content of `input`. Throws kInput and kOutput, naming it.
AssetConversion convert_asset(const ByteSource& source, const std::filesystem::path& input,
                              const std::filesystem::path& output, const AssetOptions& options,
                              const AssetResources& resources);

}  // namespace remap
