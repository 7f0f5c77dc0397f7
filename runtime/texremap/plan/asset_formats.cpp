#include "texremap/plan/asset_formats.hpp"

#include <algorithm>
#include <optional>

#include "assets/gltf/gltf_asset.hpp"
#include "assets/mtl/mtl_asset.hpp"
#include "assets/obj/obj_gltf.hpp"
#include "core/errors.hpp"
#include "sets/folder_walk.hpp"
#include "sets/name_pieces.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

enum class AssetKind { kGltf, kGlb, kMtl, kObj };
constexpr NamedValues<AssetKind, 4> kExtensions = {{{AssetKind::kGltf, ".gltf"},
                                                    {AssetKind::kGlb, ".glb"},
                                                    {AssetKind::kMtl, ".mtl"},
                                                    {AssetKind::kObj, ".obj"}}};

std::string extension_of(const fs::path& path) { return lower(path.extension().string()); }

std::optional<AssetKind> kind_of_asset(const fs::path& path) {
  return value_named(kExtensions, extension_of(path));
}

std::string obj_text(const fs::path& input, const std::string& remedy) {
  return display_path(input) + " becomes a glTF file (" + remedy +
         "; to keep MTL, give the MTL file instead)";
}

}  // namespace

bool is_asset_name(const fs::path& path) { return kind_of_asset(path).has_value(); }

bool is_obj_name(const fs::path& path) { return kind_of_asset(path) == AssetKind::kObj; }

bool is_gltf_name(const fs::path& path) {
  const std::optional<AssetKind> kind = kind_of_asset(path);
  return kind == AssetKind::kGltf || kind == AssetKind::kGlb;
}

std::vector<std::string> asset_extensions(const std::string& format) {
  std::vector<std::string> extensions;
  for (const auto& [kind, extension] : kExtensions)
    if ((kind == AssetKind::kObj) != format.empty()) extensions.emplace_back(extension.substr(1));
  return extensions;
}

std::string asset_words(const std::string& format) {
  return format.empty() ? "glTF or MTL file" : "OBJ file";
}

std::string result_extension(const fs::path& input, const std::string& format) {
  if (!format.empty() && format != "glb" && format != "gltf")
    throw usage_error("--format " + format + ": OBJ files can become glb or gltf (use --format glb)");
  const bool is_obj = kind_of_asset(input) == AssetKind::kObj;
  if (is_obj && format.empty())
    throw usage_error(obj_text(input, "use an output name *.glb or *.gltf, or add --format glb"));
  if (!is_obj && !format.empty())
    throw usage_error("--format " + format + ": " + display_path(input) +
                      " keeps its format (remove this option, which is for OBJ files)");
  return format.empty() ? "" : "." + format;
}

void require_format(const fs::path& input, const fs::path& output) {
  if (kind_of_asset(input) == AssetKind::kObj) {
    if (!is_gltf_name(output))
      throw usage_error("--output " + output.string() + ": " +
                        obj_text(input, "use an output name *.glb or *.gltf"));
  } else if (extension_of(input) != extension_of(output)) {
    throw usage_error("--output " + output.string() + ": " + display_path(input) +
                      " keeps its format (use an output name *" + extension_of(input) + ")");
  }
}

std::vector<AssetResource> resources_of_asset(const ByteSource& source, const fs::path& input,
                                              const AssetResources& resources) {
  switch (*kind_of_asset(input)) {
    case AssetKind::kMtl:
      return mtl_resources(source, display_path(input), &resources);
    case AssetKind::kObj:
      return obj_resources(source, display_path(input), resources);
    default:
      return gltf_resources(source, display_path(input));
  }
}

AssetConversion convert_asset(const ByteSource& source, const fs::path& input, const fs::path& output,
                              const AssetOptions& options, const AssetResources& resources) {
  switch (*kind_of_asset(input)) {
    case AssetKind::kMtl:
      return convert_mtl(source, display_path(input), options, &resources);
    case AssetKind::kObj:
      return gltf_of_obj(source, display_path(input), options, resources,
                         extension_of(output) == ".glb" ? "" : output.stem().string() + ".bin");
    default:
      return convert_gltf(source, display_path(input), options, &resources);
  }
}

}  // namespace remap
