// This file finds and decodes the images that MTL files refer to, below the folder of the asset. It also
// makes names for new images from them.
#pragma once

#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assets/document/asset.hpp"
#include "assets/maps/legacy_maps.hpp"
#include "assets/mtl/mtl_material.hpp"

namespace remap {

// Returns `materials/a.png` for the folder `materials` and the name `.\a.png`. A backslash is treated as '/'.
// The result may begin with `..`. Returns nothing for a name that is absolute or not a file.
std::optional<std::string> relative_path(const std::string& folder, const std::string& name);

// Returns the name without its folders.
std::string file_name_of(const std::string& name);

class MtlImages {
 public:
  // `folder` is the folder of the MTL file relative to the asset, or empty if they are the same. `resources`
  // must outlive this object, and is null if no files can be read.
  MtlImages(const AssetResources* resources, std::string folder)
      : resources_(resources), folder_(std::move(folder)) {}

  // Returns the path of a map's image, relative to the asset. If the path in the MTL file is absolute or
  // cannot be read, looks for a file of this name beside the MTL file and beside the asset, and adds a
  // warning. Returns nothing if there is no such file.
  std::optional<std::string> find(const std::string& file, std::vector<std::string>& warnings);
  // Works like find(). If the file is missing, returns the path that it would have. Returns nothing if the
  // name cannot be a file.
  std::optional<std::string> place_of(const std::string& file);

  // Returns the bytes of a file that find() found. Throws kInput.
  std::string bytes_of(const std::string& path) const;
  // Returns the pixels of a file. The last few images stay decoded.
  std::shared_ptr<const ImagePixels> load(const std::string& path);
  // Calls find(). Throws kInput, with the text of the map, if the file is missing, or if options of the map
  // would change how it looks.
  std::string require(const MtlMap& map, std::vector<std::string>& warnings);
  // Loads a map of a surface by require() and load(), and applies its option -mm.
  std::shared_ptr<const ImagePixels> load(const MtlMap& map, std::vector<std::string>& warnings);
  const AssetResources& resources() const { return *resources_; }
  const std::string& folder() const noexcept { return folder_; }

 private:
  std::vector<std::string> candidates(const std::string& file) const;

  const AssetResources* resources_;
  std::string folder_;
  std::map<std::string, std::optional<std::string>> found_;  // keyed by the name in the MTL file
  std::list<std::pair<std::string, std::shared_ptr<const ImagePixels>>> recent_;  // the newest first
};

// Returns true if a file can be opened.
bool is_there(const AssetResources& resources, const std::string& path);

// Loads the maps that the conversion of a surface needs, which multiply `factors`. Appends warnings. Throws
// kInput if a map is missing or cannot be read. Also throws if maps differ in size (unless
// `options.resamples`) or place on the surface.
LegacyMaps load_maps(const MtlSurface& surface, const LegacyMaterial& factors, MtlImages& images,
                     const AssetOptions& options, std::vector<std::string>& warnings);

// Returns a key for a conversion of maps. It consists of the names, options and factors.
std::string key_of(const MtlSurface& surface, const LegacyMaterial& factors);

// Returns a warning `map_Ns shine.png is read as ...`, because tools disagree with the specification.
std::string exponent_warning(const MtlSurface& surface);

}  // namespace remap
