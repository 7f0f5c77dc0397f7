// The MTL files that an OBJ file names, and their materials by name.
#pragma once

#include <cstddef>
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

// An MTL file and its images.
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

  // Reads the files that lines `mtllib` name: one name with spaces, or several names; if none of them is
  // there, the one that is named as the OBJ file `obj` is. Appends a warning for a file that is missing, and
  // for one whose maker gives statements a meaning of its own. Throws kInput for one that cannot be read.
  void read(const std::vector<std::string>& lines, const std::string& obj,
            std::vector<std::string>& warnings);
  // A material by its name, of several the first.
  std::optional<Entry> find(const std::string& material) const;
  // Whether Tr is 1 in every material and d in none: MeshLab writes Tr 1 for what is opaque, where the
  // specification has 1 - d.
  bool has_tr_for_opaque() const;
  // The files that were read, and the images that they name, relative to the OBJ file.
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
