// Reads and writes images in bands of rows, in the pixel types of the file. Only its sources
// image_reader.cpp, image_writer.cpp and output_spec.cpp use OpenImageIO.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "remap/channel_view.hpp"
#include "remap/transfer.hpp"
#include "system/files.hpp"

namespace remap {

struct Channel {
  std::string name;
  PixelType type = PixelType::kFloat;
  std::size_t offset = 0;  // in a texel, in bytes
  bool operator==(const Channel&) const = default;
};

// The layout of the texels of an image in memory and in the file.
struct ImageLayout {
  int width = 0;
  int height = 0;
  int x = 0;  // position of the first texel: the corner of the data window of an EXR
  int y = 0;
  std::vector<Channel> channels;
  std::size_t texel_bytes = 0;              // texels are interleaved and packed
  int alpha_channel = -1;                   // index; -1 for none
  int tile_height = 0;                      // 0 for a file that is stored by rows
  std::string format;                       // name in OpenImageIO: "openexr", "tiff", "png", "jpeg", ...
  std::string lossy_compression;            // empty for a lossless file
  std::optional<Transfer> tagged_transfer;  // of colors, where the file has a tag for it

  std::size_t row_bytes() const noexcept { return static_cast<std::size_t>(width) * texel_bytes; }
};

// Whether two images have the same number of channels with the same types.
bool same_pixel_types(const ImageLayout& a, const ImageLayout& b) noexcept;

// A channel of rows with this layout in memory.
template <typename Byte>
BasicChannelView<Byte> channel_view(Byte* texels, const ImageLayout& layout, std::size_t channel) {
  return {texels + layout.channels[channel].offset, layout.channels[channel].type,
          static_cast<std::ptrdiff_t>(layout.texel_bytes), static_cast<std::ptrdiff_t>(layout.row_bytes())};
}

// Sets the number of threads, at least 1, that OpenImageIO and OpenEXR may use in this process.
void set_image_thread_count(int count);

// Reads one part of an image; most files have one part with one level. Values are not multiplied or divided
// by alpha. Every failure, including a truncated file, is an Error of kind kInput that names the file.
class ImageReader {
 public:
  explicit ImageReader(const std::filesystem::path& path, int part = 0);
  ~ImageReader();
  ImageReader(ImageReader&&) noexcept;
  ImageReader& operator=(ImageReader&&) noexcept;

  const std::filesystem::path& path() const noexcept;
  const ImageLayout& layout() const noexcept;  // of the selected level
  int part() const noexcept;
  std::string part_name() const;     // empty for a part without a name
  int part_count() const noexcept;   // of the file
  int level_count() const noexcept;  // of the part: mip levels

  // Selects the mip level for layout() and read_rows(). The initial level 0 is the full picture.
  void select_level(int level);

  // Makes layout() and read_rows() return the picture at this size, as floats; a writer that follows this
  // reader gets the size, too. `width` and `height` are at least those of the file; `transfers` has the curve
  // of each channel. Throws kInput for a picture with mip levels or with a data window other than its display
  // window.
  void resample(int width, int height, const std::vector<Transfer>& transfers);
  bool is_resampled() const noexcept;

  // Reads rows [first_row, first_row + row_count), counted from 0 at the top, into `texels`, which holds
  // row_count * layout().row_bytes(). For tiled files the rows must begin and end at multiples of the tile
  // height or at the end of the image.
  void read_rows(int first_row, int row_count, std::byte* texels);

  // The metadata that an earlier run wrote under `name`, as an attribute or in the tag Software.
  std::optional<std::string> noted_metadata(const std::string& name) const;

 private:
  friend class ImageWriter;
  struct State;  // image_library.hpp
  std::unique_ptr<State> state_;
};

using Metadata = std::vector<std::pair<std::string, std::string>>;  // name and text

// How a new image stores its colors, by the pixel type that it has.
struct ColorStorage {
  std::optional<Transfer> chosen;    // by the user
  std::optional<Transfer> followed;  // by the whole numbers of the map that the colors follow

  Transfer of(PixelType type) const {
    const Transfer usual = usual_color_transfer(type);
    return chosen.value_or(is_integer(type) ? followed.value_or(usual) : usual);
  }
};

// The differences of a new image from the image that it follows.
struct ImageChanges {
  std::optional<PixelType> type;                     // of all channels
  std::optional<std::vector<std::string>> channels;  // new channels, all of the type of the first old one
  std::optional<ColorStorage> colors;                // none: all channels are data
  Metadata metadata;                                 // added; TIFF and JPEG hold it in the tag Software
};

// One part of a new image. It follows a part of another image in everything except `changes`.
struct ImagePart {
  const ImageReader* model = nullptr;  // used by the constructor of ImageWriter only
  ImageChanges changes;
};

// Writes an image whose parts follow other images in pixel types, compression, tiling, channel names,
// metadata, windows and mip levels, as far as the format (chosen by the extension of `path`) can hold them.
// It writes to a temporary name in the same folder. Every failure, including a full disk, is an Error of kind
// kOutput that names `path`.
class ImageWriter {
 public:
  ImageWriter(const std::filesystem::path& path, const std::vector<ImagePart>& parts);
  ~ImageWriter();  // removes a file that was not committed
  ImageWriter(ImageWriter&&) noexcept;
  ImageWriter& operator=(ImageWriter&&) noexcept;

  const std::filesystem::path& path() const noexcept;
  const ImageLayout& layout() const noexcept;  // of the selected plane
  int level_count(int part) const noexcept;
  ImageLayout layout(int part) const;  // of its level 0

  // Selects the next plane: all levels of a part in order, the largest first, then the next part. The
  // previous plane must be complete. The initial plane is level 0 of part 0.
  void select(int part, int level);

  // Writes the next rows from the top, with the rules of ImageReader::read_rows.
  void write_rows(int first_row, int row_count, const std::byte* texels);

  // Closes and checks the file. Afterwards the system has accepted every byte.
  void finish();
  // The finished file, under its temporary name.
  const std::filesystem::path& finished_file() const noexcept;

  // Renames the finished file to its final name and replaces an existing file.
  void commit(Flush flush = Flush::kYes);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace remap
