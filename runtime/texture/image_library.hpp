// Images in files, as those read and write them whose commands these are: the programs by a module that alone
// calls OpenImageIO, a package for another language by what that language has (packages/).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assets/document/image_codec.hpp"
#include "core/files.hpp"
#include "texture/image_layout.hpp"

namespace remap {

// One part of an image file, opened for reading; most files have one part with one level. Values are not
// multiplied or divided by alpha. Every failure, including a truncated file, is an Error of kind kInput that
// names the file.
class StoredImage {
 public:
  virtual ~StoredImage() = default;
  virtual const ImageLayout& layout() const noexcept = 0;  // of the selected level
  virtual std::string part_name() const = 0;               // empty for a part without a name
  virtual int part_count() const noexcept = 0;             // of the file; only part 0 knows it
  virtual int level_count() const noexcept = 0;            // of the part: mip levels
  // Selects the mip level for layout() and read_rows(). The initial level 0 is the full picture.
  virtual void select_level(int level) = 0;
  // Sets the size of new images that follow this one. Throws kInput for a picture with mip levels or with a
  // data window other than its display window.
  virtual void set_followed_size(int width, int height) = 0;
  // Reads rows [first_row, first_row + row_count), counted from 0 at the top, into `texels`, which holds
  // row_count * layout().row_bytes(). For tiled files the rows must begin and end at multiples of the tile
  // height or at the end of the image.
  virtual void read_rows(int first_row, int row_count, std::byte* texels) = 0;
  // The metadata that an earlier run wrote under `name`, as an attribute or in the tag Software.
  virtual std::optional<std::string> noted_metadata(const std::string& name) const = 0;
};

// One part of a new image. It follows a part of another image in everything except `changes`.
struct NewPart {
  const StoredImage* model = nullptr;  // used by ImageLibrary::create() only
  ImageChanges changes;
};

// An image that is being written to a temporary name in the folder of its path. Every failure, including a
// full disk, is an Error of kind kOutput that names the path. The destructor removes a file that was not
// committed.
class NewImage {
 public:
  virtual ~NewImage() = default;
  virtual const std::filesystem::path& path() const noexcept = 0;
  virtual const ImageLayout& layout() const noexcept = 0;  // of the selected plane
  virtual int level_count(int part) const noexcept = 0;
  virtual ImageLayout layout(int part) const = 0;  // of its level 0
  // Selects the next plane: all levels of a part in order, the largest first, then the next part. The
  // previous plane must be complete. The initial plane is level 0 of part 0.
  virtual void select(int part, int level) = 0;
  // Writes the next rows from the top, with the rules of StoredImage::read_rows.
  virtual void write_rows(int first_row, int row_count, const std::byte* texels) = 0;
  // Ends and checks the file. Afterwards the system has accepted every byte.
  virtual void finish() = 0;
  // The finished file, under its temporary name.
  virtual const std::filesystem::path& finished_file() const noexcept = 0;
  // What the finished file holds, to be read; of a host that keeps its file open, without opening it again.
  virtual std::shared_ptr<const InputFile> content() const {
    return std::make_shared<const InputFile>(finished_file());
  }
  // Waits until the finished file is on the disk. Throws as finish().
  virtual void flush_to_disk() const { remap::flush_to_disk(finished_file(), path()); }
  // Renames the finished file to its final name and replaces an existing file.
  virtual void commit(Flush flush) = 0;
};

// A whole picture as floats.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;  // names
  std::vector<float> values;          // interleaved, row-major from the top
};

struct ImageLimits {
  int threads = 0;                 // at least 1, of the image library in this process; 0: its own choice
  std::uint64_t memory_bytes = 0;  // of the texels of one image at once; 0: its own choice
};

class ImageLibrary {
 public:
  virtual ~ImageLibrary() = default;
  // Sets what images that are opened later may take.
  virtual void set_limits(const ImageLimits& limits) const = 0;
  // `path` leads to a regular file.
  virtual std::unique_ptr<StoredImage> open(const std::filesystem::path& path, int part) const = 0;
  // The same of a file that is open; a host that only knows names opens it by its own.
  virtual std::unique_ptr<StoredImage> open_part(const std::shared_ptr<const InputFile>& file,
                                                 int part) const {
    return open(file->path(), part);
  }
  // The new image follows the models of `parts` in pixel types, compression, tiling, channel names, metadata,
  // windows and mip levels, as far as the format (chosen by the extension of `path`) can hold them.
  virtual std::unique_ptr<NewImage> create(const std::filesystem::path& path,
                                           const std::vector<NewPart>& parts) const = 0;

  // Reads every channel of the first part. `path` leads to a regular file. Throws kInput.
  virtual Picture read_picture(const std::filesystem::path& path) const = 0;
  // Writes a picture: float32 (zip) with `attributes` as metadata, or 8 bits. The file appears complete or
  // not at all. Throws kOutput.
  virtual void write_exr(const std::filesystem::path& path, const Picture& picture,
                         const std::map<std::string, std::string>& attributes) const = 0;
  virtual void write_png(const std::filesystem::path& path, const Picture& picture) const = 0;
  // The bytes of such a PNG file. Throws kOutput.
  virtual std::string png_bytes(const Picture& picture) const = 0;
  // Images that assets embed or name: PNG, JPEG, WebP, BMP, TIFF and Targa.
  virtual const ImageCodec& codec() const = 0;
};

// What image_library() keeps, defined by the host. That of the programs loads the module, whose 260 shared
// libraries take longer to load than most commands run; it lies in a folder beside that of the program.
// Throws kInput, with the reason and what to do, if it is not there or cannot be loaded.
const ImageLibrary& load_image_library();

// The library of images, which the first call loads; after a failure a later call tries again. Callable from
// many threads.
const ImageLibrary& image_library();

// Sets what images that are opened later may take. Loads nothing.
void set_image_limits(const ImageLimits& limits);

}  // namespace remap
