// The images that MTL files name: looked for below the folder of the asset, decoded, and new ones named after
// them.
#pragma once

#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "assets/document/asset.hpp"
#include "assets/maps/legacy_maps.hpp"
#include "assets/mtl/mtl_material.hpp"

namespace remap {

// `materials/a.png` of the folder `materials` and the name `.\a.png`; none for a name that is absolute or no
// file. A backslash counts as '/'. It may begin with `..`.
std::optional<std::string> relative_path(const std::string& folder, const std::string& name);

// The name without its folders.
std::string file_name_of(const std::string& name);

class MtlImages {
 public:
  // `folder`: of the MTL file, relative to the asset; empty where they are the same. `resources` must outlive
  // it, and is null where no files can be read.
  MtlImages(const AssetResources* resources, std::string folder)
      : resources_(resources), folder_(std::move(folder)) {}

  // Where the image of a map lies, relative to the asset. A name that is absolute or leads to nothing that
  // may be read counts as its file name beside the MTL file, or beside the asset, and appends a warning. None
  // where nothing is there.
  std::optional<std::string> find(const std::string& file, std::vector<std::string>& warnings);
  // Like find(), but if the file is missing, returns the path where it would have to be. None if the name
  // cannot be a file.
  std::optional<std::string> place_of(const std::string& file);

  // The bytes of a file that find() found. Throws kInput.
  std::string bytes_of(const std::string& path) const;
  // Its pixels; the last few stay decoded.
  std::shared_ptr<const ImagePixels> load(const std::string& path);
  // find(). Throws kInput, naming the map, where it is missing or has options that change what it looks like.
  std::string require(const MtlMap& map, std::vector<std::string>& warnings);
  // A map of a surface: require() and load(), with its -mm.
  std::shared_ptr<const ImagePixels> load(const MtlMap& map, std::vector<std::string>& warnings);
  const AssetResources& resources() const { return *resources_; }
  const std::string& folder() const noexcept { return folder_; }

 private:
  std::vector<std::string> candidates(const std::string& file) const;

  const AssetResources* resources_;
  std::string folder_;
  std::map<std::string, std::optional<std::string>> found_;  // by the name in the MTL file
  std::list<std::pair<std::string, std::shared_ptr<const ImagePixels>>> recent_;  // the newest first
};

// Whether a file can be opened.
bool is_there(const AssetResources& resources, const std::string& path);

// The decoded maps of a surface, all of one size.
struct SurfaceMaps {
  std::shared_ptr<const ImagePixels> diffuse, specular, exponent;  // null for none

  // They must outlive the result.
  LegacyMaps with(const LegacyMaterial& factors, const MtlSurface& surface, bool as_dielectric) const;
};

// Loads the maps that the conversion of a surface needs. Appends warnings. Throws kInput where one is missing
// or cannot be read, and where they differ in size (unless `options.enlarges`) or in their place on the
// surface.
SurfaceMaps load_maps(const MtlSurface& surface, MtlImages& images, const AssetOptions& options,
                      std::vector<std::string>& warnings);

// The key of a conversion of maps: their names, options and factors.
std::string key_of(const MtlSurface& surface, const LegacyMaterial& factors);

// `map_Ns shine.png is read as ...`, which the specification says and tools do not agree on.
std::string exponent_warning(const MtlSurface& surface);

}  // namespace remap
