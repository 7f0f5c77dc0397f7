// This file finds the MTL files that an OBJ file refers to, and their materials by name.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "assets/document/asset.hpp"
#include "assets/document/mtl_document.hpp"
#include "assets/mtl/mtl_images.hpp"

namespace remap {

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
