// This file adds images and textures to a new glTF file, and builds its only buffer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "assets/document/asset.hpp"
#include "assets/document/asset_uri.hpp"
#include "assets/mtl/mtl_libraries.hpp"
#include "assets/mtl/mtl_material.hpp"
#include "core/json.hpp"

namespace remap {

// These are targets of buffer views (glTF 2.0, section 5.11).
inline constexpr int kVertexTarget = 34962, kIndexTarget = 34963;

class GltfBuffer {
 public:
  // Appends bytes from a multiple of four. Returns the index of their view.
  std::size_t add_view(std::string bytes, std::optional<int> target = std::nullopt) {
    Json view{{"buffer", 0}, {"byteOffset", padded_size()}, {"byteLength", bytes.size()}};
    if (target) view["target"] = *target;
    views_.push_back(std::move(view));
    size_ = padded_size() + bytes.size();
    parts_.push_back(std::move(bytes));
    return views_.size() - 1;
  }

  std::uint64_t size() const noexcept { return size_; }
  // Returns the size as a multiple of four, as the chunk of a .glb needs.
  std::uint64_t padded_size() const noexcept { return (size_ + 3) / 4 * 4; }
  // Returns the bytes, filled up to `size` with zeros. The buffer frees each part after copying it.
  std::string take(std::uint64_t size) {
    std::string bytes;
    bytes.reserve(static_cast<std::size_t>(size));
    for (std::string& part : parts_) {
      bytes.append((4 - bytes.size() % 4) % 4, '\0');
      bytes += std::exchange(part, std::string());
    }
    bytes.resize(static_cast<std::size_t>(size));
    return bytes;
  }
  const Json& views() const noexcept { return views_; }

 private:
  std::vector<std::string> parts_;  // bytes of the views
  std::uint64_t size_ = 0;
  Json views_ = Json::list();
};

enum class NewImagePlace {
  kBuffer,  // into the buffer
  kFiles,   // existing files stay where they are, and new files are next to them
};

class GltfTextures {
 public:
  // All arguments must outlive this object. New files, and resources that stay, are added to `conversion`.
  GltfTextures(const AssetOptions& options, const AssetResources& resources, NewImagePlace place,
               GltfBuffer& buffer, AssetConversion& conversion)
      : png_level_(options.png_level.value_or(kUsualPngLevel)),
        resources_(resources),
        place_(place),
        buffer_(buffer),
        conversion_(conversion),
        names_(resources.image_prefix()) {}

  // Reserves a path, so that no new image gets it.
  void take(const std::string& path) { names_.take(path); }
  // Adds the image of a map. Each file is added only once. PNG and JPEG stay unchanged. Other formats, and
  // maps with -mm, become PNG. Adds warnings. Throws kInput if the image is missing, cannot be read, or has
  // options that change how it looks.
  std::size_t add_file(MtlImages& images, const MtlMap& map, std::vector<std::string>& warnings);
  // Adds an image with a name from `model`. If an earlier image has equal bytes, uses that image. Returns the
  // index.
  std::size_t add_pixels(MtlImages& images, const ImagePixels& pixels, const MtlMap& model,
                         std::string_view suffix);
  // Returns a reference to a texture of an image, with its place on the surface from `map`.
  Json info(std::size_t image, const MtlMap& map);

  // Returns the number of references so far.
  std::size_t info_count() const noexcept { return info_count_; }
  bool has_transforms() const noexcept { return has_transforms_; }
  // Return the lists of the file, each of which may be empty.
  const Json& textures() const noexcept { return textures_; }
  const Json& images() const noexcept { return images_; }
  const Json& samplers() const noexcept { return samplers_; }

 private:
  std::size_t add_bytes(std::string bytes, const char* type, const std::string& path);
  std::size_t add_uri(const std::string& path);

  int png_level_;
  const AssetResources& resources_;
  NewImagePlace place_;
  GltfBuffer& buffer_;
  AssetConversion& conversion_;
  Json textures_ = Json::list(), images_ = Json::list(), samplers_ = Json::list();
  NewImageNames names_;
  std::map<std::string, std::size_t> of_files_;  // images by path, and options with -mm
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> of_bytes_;  // new images by size and hash
  // textures, keyed by their image and whether they clamp
  std::map<std::pair<std::size_t, bool>, std::size_t> of_images_;
  std::size_t info_count_ = 0;
  bool has_transforms_ = false;
};

inline constexpr std::string_view kTextureTransform = "KHR_texture_transform";

// Returns the value rounded to float, as viewers store it, with the shortest text.
double float_value(double value);

// Returns a text that JSON can hold. A text that is not UTF-8 is read as Latin-1.
std::string utf8_name(const std::string& text);

}  // namespace remap
