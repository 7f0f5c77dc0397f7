#include "texremap/asset_formats.hpp"

#include <algorithm>
#include <array>

#include "assets/gltf_asset.hpp"
#include "core/errors.hpp"
#include "sets/folder_walk.hpp"
#include "sets/name_pieces.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

struct AssetFormat {
  std::string_view extension;
  AssetConversion (*convert)(const ByteSource&, const std::string&, const AssetOptions&,
                             const AssetResources*);
  std::vector<AssetResource> (*resources)(const ByteSource&, const std::string&);
};
constexpr std::array<AssetFormat, 2> kAssetFormats = {
    {{".gltf", convert_gltf, gltf_resources}, {".glb", convert_gltf, gltf_resources}}};

std::string extension_of(const fs::path& path) { return lower(path.extension().string()); }

const AssetFormat& format_of(const fs::path& path) {
  return *std::ranges::find(kAssetFormats, extension_of(path), &AssetFormat::extension);
}

}  // namespace

bool is_asset_name(const fs::path& path) {
  return std::ranges::find(kAssetFormats, extension_of(path), &AssetFormat::extension) != kAssetFormats.end();
}

std::vector<std::string> asset_extensions(const std::string&) {
  std::vector<std::string> extensions;
  for (const AssetFormat& format : kAssetFormats) extensions.emplace_back(format.extension.substr(1));
  return extensions;
}

std::string asset_words(const std::string&) { return "glTF file"; }

std::string result_extension(const fs::path&, const std::string&) { return ""; }

void require_format(const fs::path& input, const fs::path& output) {
  if (extension_of(input) != extension_of(output))
    throw usage_error("--output " + output.string() + ": " + shown(input) +
                      " stays a file of its kind (name it *" + extension_of(input) + ")");
}

std::vector<AssetResource> resources_of_asset(const ByteSource& source, const fs::path& input) {
  return format_of(input).resources(source, shown(input));
}

AssetConversion convert_asset(const ByteSource& source, const fs::path& input, const fs::path&,
                              const AssetOptions& options, const AssetResources& resources) {
  return format_of(input).convert(source, shown(input), options, &resources);
}

}  // namespace remap
