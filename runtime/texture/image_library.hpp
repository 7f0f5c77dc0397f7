// This file reads and writes images in files through an interface. The programs implement the interface in a
// module, the only code that calls OpenImageIO. A package for another language implements it with image
// functions of that language (packages/). It also describes layouts of images, and how a new image may differ
// from its model.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assets/document/asset.hpp"
#include "core/files.hpp"
#include "remap/pixels.hpp"

namespace remap {

struct Channel {
  std::string name;
  PixelType type = PixelType::kFloat;
  std::size_t offset = 0;  // place in a texel, in bytes
  bool operator==(const Channel&) const = default;
};

// An ImageLayout is the layout of an image's texels in memory and in the file.
struct ImageLayout {
  int width = 0;
  int height = 0;
  int x = 0;  // position of the first texel; in EXR, the corner of the data window
  int y = 0;
  std::vector<Channel> channels;
  std::size_t texel_bytes = 0;              // size of a texel; channels are interleaved without gaps
  int alpha_channel = -1;                   // index, or -1
  int tile_height = 0;                      // 0 for a file that is stored by rows
  std::string format;                       // name in OpenImageIO: "openexr", "tiff", "png", "jpeg", ...
  std::string lossy_compression;            // empty for a lossless file
  bool has_compression_level = false;       // true if the compression has a level
  std::optional<Transfer> tagged_transfer;  // transfer curve of colors, if the file states it

  std::size_t row_bytes() const noexcept { return static_cast<std::size_t>(width) * texel_bytes; }
};

// Returns true if two images have the same number of channels with the same types.
inline bool same_pixel_types(const ImageLayout& a, const ImageLayout& b) noexcept {
  return std::ranges::equal(a.channels, b.channels,
                            [](const Channel& x, const Channel& y) { return x.type == y.type; });
}

// Returns a channel of rows that have this layout.
template <typename Byte>
BasicChannelView<Byte> channel_view(Byte* texels, const ImageLayout& layout, std::size_t channel) {
  return {texels + layout.channels[channel].offset, layout.channels[channel].type,
          static_cast<std::ptrdiff_t>(layout.texel_bytes), static_cast<std::ptrdiff_t>(layout.row_bytes())};
}

using Metadata = std::vector<std::pair<std::string, std::string>>;  // name and text

// A ColorStorage decides how a new image stores its colors, depending on its pixel type.
struct ColorStorage {
  std::optional<Transfer> chosen;    // chosen by the user
  std::optional<Transfer> followed;  // curve of the integer map that the colors are made from

  Transfer of(PixelType type) const {
    const Transfer usual = usual_color_transfer(type);
    return chosen.value_or(is_integer(type) ? followed.value_or(usual) : usual);
  }
};

// An ImageChanges lists how a new image differs from the image that it follows.
struct ImageChanges {
  std::optional<PixelType> type;                     // type of all channels
  std::optional<std::vector<std::string>> channels;  // new names; all have the type of the old channel 0
  std::optional<ColorStorage> colors;                // if unset, all channels are data
  std::optional<int> compression_level;              // 1 (fast) to 9 (small), if the compression has levels
  Metadata metadata;  // tags to add; TIFF and JPEG store them in the tag Software
};

// A StoredImage is one part of an image file, opened for reading. Most files have one part with one level.
// Values are not multiplied or divided by alpha. Every failure is an Error of kind kInput with the file's
// name, even for a truncated file.
class StoredImage {
 public:
  virtual ~StoredImage() = default;
  virtual const ImageLayout& layout() const noexcept = 0;  // layout of the selected level
  virtual std::string part_name() const = 0;               // empty for a part without a name
  virtual int part_count() const noexcept = 0;   // number of parts in the file; call it for part 0 only
  virtual int level_count() const noexcept = 0;  // mip levels of the part
  // Selects the mip level for layout() and read_rows(). The initial level 0 is the full picture.
  virtual void select_level(int level) = 0;
  // Sets the size of new images that follow this one. Throws kInput for a picture with mip levels or with a
  // data window other than its display window.
  virtual void set_followed_size(int width, int height) = 0;
  // Reads rows [first_row, first_row + row_count), counted from 0 at the top, into `texels`, which has room
  // for row_count * layout().row_bytes(). In tiled files, the rows must begin at a multiple of the tile
  // height, and end at such a multiple or at the end of the image.
  virtual void read_rows(int first_row, int row_count, std::byte* texels) = 0;
  // Returns the metadata that an earlier run wrote under `name`, as an attribute or in the tag Software.
  virtual std::optional<std::string> noted_metadata(const std::string& name) const = 0;
};

// A NewPart is one part of a new image. It equals a part of another image in everything except `changes`.
struct NewPart {
  const StoredImage* model = nullptr;  // only ImageLibrary::create() uses it
  ImageChanges changes;
};

// A NewImage is being written to a temporary name in the folder of its path. Every failure is an Error of
// kind kOutput with the path, even if the disk is full. The destructor removes a file that was not committed.
class NewImage {
 public:
  virtual ~NewImage() = default;
  virtual const std::filesystem::path& path() const noexcept = 0;
  virtual const ImageLayout& layout() const noexcept = 0;  // layout of the selected plane
  virtual int level_count(int part) const noexcept = 0;
  virtual ImageLayout layout(int part) const = 0;  // layout of level 0
  // Selects the next plane. The planes are all levels of a part, the largest first, and then all levels of
  // the next part. The previous plane must be complete. At first, level 0 of part 0 is selected.
  virtual void select(int part, int level) = 0;
  // Writes the next rows from the top, with the rules of StoredImage::read_rows.
  virtual void write_rows(int first_row, int row_count, const std::byte* texels) = 0;
  // Ends and checks the file. After this, the system has accepted every byte.
  virtual void finish() = 0;
  // Returns the path of the finished file, which still has its temporary name.
  virtual const std::filesystem::path& finished_file() const noexcept = 0;
  // Returns the content of the finished file for reading. A host that still has the file open does not open
  // it again.
  virtual std::shared_ptr<const InputFile> content() const {
    return std::make_shared<const InputFile>(finished_file());
  }
  // Waits until the finished file is on the disk. Throws like finish().
  virtual void flush_to_disk() const { remap::flush_to_disk(finished_file(), path()); }
  // Renames the finished file to its final name and replaces an existing file.
  virtual void commit(Flush flush) = 0;
};

// A Picture is a whole picture as floats.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;  // channel names
  std::vector<float> values;          // interleaved, row-major from the top
};

class ImageLibrary {
 public:
  virtual ~ImageLibrary() = default;
  // Does what set_image_limits() describes.
  virtual void set_limits(int threads, std::uint64_t memory_bytes) const = 0;
  // Opens a part of `path`, which must be a regular file.
  virtual std::unique_ptr<StoredImage> open(const std::filesystem::path& path, int part) const = 0;
  // Opens a part of a file that is already open. A host that can open files only by name opens it by its
  // name.
  virtual std::unique_ptr<StoredImage> open_part(const std::shared_ptr<const InputFile>& file,
                                                 int part) const {
    return open(file->path(), part);
  }
  // Creates a new image from the models of `parts`. It has their pixel types, compression, tiling, channel
  // names, metadata, windows and mip levels, if its format can hold them. The extension of `path` chooses the
  // format.
  virtual std::unique_ptr<NewImage> create(const std::filesystem::path& path,
                                           const std::vector<NewPart>& parts) const = 0;

  // Reads every channel of the first part of `path`, which must be a regular file. Throws kInput.
  virtual Picture read_picture(const std::filesystem::path& path) const = 0;
  // Writes a picture as float32 (zip) with `attributes` as metadata, or with 8 bits. The file appears
  // complete or not at all. Throws kOutput.
  virtual void write_exr(const std::filesystem::path& path, const Picture& picture,
                         const std::map<std::string, std::string>& attributes) const = 0;
  virtual void write_png(const std::filesystem::path& path, const Picture& picture) const = 0;
  // Returns the bytes of a PNG file with 8 bits. Throws kOutput.
  virtual std::string png_bytes(const Picture& picture) const = 0;
  // Returns the codec for images that assets embed or name: PNG, JPEG, WebP, BMP, TIFF and Targa.
  virtual const ImageCodec& codec() const = 0;
};

// Loads the library for image_library(). Each host defines this function. The programs load a module from a
// folder beside them, because its 260 shared libraries take longer to load than most commands take to run.
// Throws kInput, with the reason and the fix, if the module is missing or cannot be loaded.
const ImageLibrary& load_image_library();

// Returns the image library, which the first call loads. After a failure, a later call tries again. Many
// threads may call this.
const ImageLibrary& image_library();

// Sets limits for images that are opened later: the threads of this process, and the memory for one image's
// texels. A limit of 0 is automatic. Does not load the library.
void set_image_limits(int threads, std::uint64_t memory_bytes);

}  // namespace remap
