// This file reads MTL files: their text, the images that they refer to below the folder of the asset, and for
// an OBJ file its MTL files and their materials by name.
#pragma once

#include <list>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "assets/document/asset.hpp"
#include "assets/document/mtl_document.hpp"
#include "assets/maps/legacy_maps.hpp"
#include "assets/mtl/mtl_material.hpp"

namespace remap {

// Returns the text of an MTL file as UTF-8. Throws kInput, beginning with `context`, if it is too long, and
// for UTF-16 with an incomplete character.
std::string mtl_text(const ByteSource& source, const std::string& context);
// Returns true if a word names an image: map_Kd, bump, norm and the like, in lower case.
bool is_mtl_map(const std::string& word);

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

struct MtlLibrary {
  // `path` is relative to the OBJ file. `resources` must outlive this object. Without `maker`, the file
  // itself shows who wrote it.
  MtlLibrary(std::string content, const std::string& path, const AssetResources& resources,
             std::optional<MtlMaker> maker);

  std::string text;
  MtlDocument document;
  MtlMaker maker;
  MtlImages images;
};

class MtlLibraries {
 public:
  struct Entry {
    MtlLibrary* library = nullptr;
    const MtlBlock* block = nullptr;
  };

  MtlLibraries(const AssetResources& resources, std::optional<MtlMaker> maker)
      : resources_(resources), maker_(maker) {}

  // Reads the files of the lines `mtllib`. A line has either one name with spaces, or several names. If no
  // file exists, reads the MTL file with the name of the OBJ file `obj`. Adds a warning for a missing file,
  // and for a file whose maker gives statements another meaning. Throws kInput for a file that cannot be
  // read.
  void read(const std::vector<std::string>& lines, const std::string& obj,
            std::vector<std::string>& warnings);
  // Returns a material by its name. If several materials have this name, returns the first.
  std::optional<Entry> find(const std::string& material) const;
  // Returns true if every material has Tr 1 and no material has d. By the specification, Tr 1 means
  // invisible, but MeshLab writes Tr 1 for opaque materials.
  bool has_tr_for_opaque() const;
  // Return the files that were read, and the images that they refer to, relative to the OBJ file.
  const std::set<std::string>& paths() const noexcept { return paths_; }
  const std::set<std::string>& image_paths() const noexcept { return image_paths_; }

 private:
  bool read_file(const std::string& name, std::vector<std::string>& warnings);

  const AssetResources& resources_;
  std::optional<MtlMaker> maker_;
  std::vector<std::unique_ptr<MtlLibrary>> libraries_;
  std::set<std::string> paths_, image_paths_;
  std::map<std::string, Entry> entries_;
};

}  // namespace remap
