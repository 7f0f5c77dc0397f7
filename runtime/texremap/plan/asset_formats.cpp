#include "texremap/plan/asset_formats.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "assets/gltf/gltf_asset.hpp"
#include "assets/mtl/mtl_asset.hpp"
#include "assets/obj/obj_gltf.hpp"
#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/plain_text.hpp"
#include "sets/folder_walk.hpp"
#include "sets/naming.hpp"

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

namespace {

// This is the advice for a file that texremap does not read.
constexpr std::string_view kExport = "convert it to glTF or OBJ first, for example with Blender";
constexpr std::string_view kTextures =
    "export its textures and convert their folder, or give values such as --roughness 0.3";
constexpr std::string_view kMtlx =
    "the Python package converts its materials: texremap mtlx FILE --to gltf -o out.glb";
constexpr std::string_view kUsd = "the Python package converts its materials: texremap usd FILE";
constexpr std::string_view kMujoco =
    "give its values instead: texremap convert --from mujoco --to gltf --roughness 64 --specular 0.2 "
    "--diffuse 0.5; the roughness is 128 times the shininess";
constexpr std::string_view kPhong =
    "give its values instead: texremap convert --from opengl --to gltf --roughness 64 --specular 0.2 "
    "--diffuse 0.5";
constexpr std::string_view kRadiance =
    "give its values instead: texremap convert --from radiance/plastic --to gltf --roughness 0.1 --specular "
    "0.05 --diffuse 0.5";
constexpr std::string_view kModels =
    "give its values instead: texremap convert --from MODEL --to gltf --roughness 0.3 --specular 0.04 "
    "--diffuse 0.5; texremap list shows the models";

struct UnreadFormat {
  std::string_view extensions, name, remedy;
};
constexpr std::array<UnreadFormat, 34> kUnread = {{
    {".dae", "COLLADA", kExport},
    {".fbx", "FBX", kExport},
    {".blend", "Blender", kExport},
    {".3ds .max", "3ds Max", kExport},
    {".ma .mb", "Maya", kExport},
    {".c4d", "Cinema 4D", kExport},
    {".lwo .lws", "LightWave", kExport},
    {".hip .hiplc .hipnc", "Houdini", kExport},
    {".skp", "SketchUp", kExport},
    {".3dm", "Rhino", kExport},
    {".abc", "Alembic", kExport},
    {".x3d .wrl .vrml", "X3D and VRML", kExport},
    {".stl", "STL", kExport},
    {".ply", "PLY", kExport},
    {".off", "OFF", kExport},
    {".3mf", "3MF", kExport},
    {".vrm", "VRM", kExport},
    {".step .stp .iges .igs", "CAD", kExport},
    {".usd .usda .usdc .usdz", "USD", kUsd},
    {".mjcf", "MuJoCo", kMujoco},
    {".xml", "MuJoCo or Mitsuba", kMujoco},
    {".urdf .xacro", "URDF", kPhong},
    {".sdf .world", "SDF", kPhong},
    {".rad", "Radiance", kRadiance},
    {".mat", "Radiance, Unity or MATLAB", kRadiance},
    {".pov .inc", "POV-Ray", kModels},
    {".pbrt", "pbrt", kModels},
    {".mtlx", "MaterialX", kMtlx},
    {".mdl", "MDL", kTextures},
    {".osl .oso", "OSL", kTextures},
    {".sbsar .sbs .spp .spsm", "Substance", kTextures},
    {".uasset .uexp .umap", "Unreal", kTextures},
    {".tres .tscn .material", "Godot", kTextures},
    {".unity .prefab .unitypackage .asset .shadergraph", "Unity", kTextures},
}};

constexpr const char* kRead = "glTF, GLB, OBJ and MTL";

bool is_regular(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

}  // namespace

void require_readable(const fs::path& path) {
  if (!is_regular(path)) return;
  const std::string extension = lower(path.extension().string());
  const auto found = std::ranges::find_if(kUnread, [&](const UnreadFormat& format) {
    const std::vector<std::string> extensions = parts_between(format.extensions, ' ');
    return contains(extensions, extension);
  });
  if (found == kUnread.end()) return;
  std::string remedy(found->remedy);
  if (const std::size_t at = remedy.find("FILE"); at != std::string::npos)
    remedy.replace(at, 4, shell_word(path.string()));
  throw usage_error(display_path(path) + ": texremap does not read " + std::string(found->name) +
                    " files, only " + kRead + " (" + remedy + ")");
}

void require_one_kind(const fs::path& first, const std::vector<fs::path>& more) {
  require_readable(first);
  for (const fs::path& path : more) require_readable(path);
  if (more.empty()) {
    if (!is_regular(first) || is_asset_name(first)) return;
    throw usage_error(display_path(first) +
                      ": not a glTF, GLB, MTL or OBJ file, and not a folder (give the folder of a set, or "
                      "its maps by --roughness, --base-color, ...)");
  }
  std::string whole = first.string();
  for (const fs::path& path : more) whole += " " + path.string();
  std::vector<fs::path> all = more;
  if (!is_asset_name(first)) all.push_back(first);
  const auto other = std::ranges::find_if(all, [](const fs::path& path) { return !is_asset_name(path); });
  if (other == all.end()) return;
  std::error_code ignored;
  std::string remedy = "put paths with spaces in quotes: \"" + display_path(whole) + "\"";
  if (!fs::exists(whole, ignored) && fs::exists(*other, ignored) && fs::exists(first, ignored))
    remedy = fs::is_directory(*other, ignored) ? "convert one folder at a time" : "remove it";
  throw usage_error(display_path(*other) + ": not a glTF, MTL or OBJ file (" + remedy + ")");
}

}  // namespace remap
