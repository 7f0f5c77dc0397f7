// Images in and out, a band of rows at a time, in the pixel types of the file. The only door to
// OpenImageIO (image_reader.cpp, image_writer.cpp, output_spec.cpp).
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "texture/pixel_type.hpp"
#include "texture/transfer.hpp"

namespace remap {

struct Channel {
  std::string name;
  PixelType type = PixelType::kFloat;
  std::size_t offset = 0;  // of its bytes in a texel
  bool operator==(const Channel&) const = default;
};

// How the texels of an image lie in memory and in the file.
struct ImageLayout {
  int width = 0;
  int height = 0;
  int x = 0;  // position of the first texel; not 0 where the data window of an EXR is not
  int y = 0;
  std::vector<Channel> channels;
  std::size_t texel_bytes = 0;       // texels are interleaved and packed
  int alpha_channel = -1;            // index, -1 where there is none
  int tile_height = 0;               // 0 where the file is stored by rows
  std::string format;                // as OpenImageIO names it: "openexr", "tiff", "png", "jpeg", ...
  std::string lossy_compression;     // empty where the file keeps every bit
  bool is_tagged_nonlinear = false;  // the file says that its values are not linear (sRGB)

  std::size_t row_bytes() const noexcept { return static_cast<std::size_t>(width) * texel_bytes; }
};

// How many threads OpenImageIO and OpenEXR may use in this process, at least 1.
void set_image_thread_count(int count);

// Reads one part of an image; most files have one part of one level. Associated alpha or not, values arrive
// as they are stored. Every failure is Error kInput and names the file; a file that ends early is a failure.
class ImageReader {
 public:
  explicit ImageReader(const std::filesystem::path& path, int part = 0);
  ~ImageReader();
  ImageReader(ImageReader&&) noexcept;
  ImageReader& operator=(ImageReader&&) noexcept;

  const std::filesystem::path& path() const noexcept;
  const ImageLayout& layout() const noexcept;  // of the level that is read
  int part() const noexcept;
  std::string part_name() const;     // empty where it has none
  int part_count() const noexcept;   // of the file
  int level_count() const noexcept;  // of the part: mip levels

  // From now on layout() and read_rows() are about this level; 0, at first, is the whole picture.
  void select_level(int level);

  // From now on layout() and read_rows() give the picture at this size, as floats, and a writer that follows
  // it has the size, too. `width`, `height`: at least its own. `transfers`: the curve of each channel. Throws
  // kInput for a picture of several levels, and for one whose data window is not its display window.
  void resample(int width, int height, const std::vector<Transfer>& transfers);
  bool is_resampled() const noexcept;

  // Rows [first_row, first_row + row_count), counted from 0 at the top, to `texels`, which holds
  // row_count * layout().row_bytes(). Tiled files: both are multiples of the tile height, or reach the end.
  void read_rows(int first_row, int row_count, std::byte* texels);

 private:
  friend class ImageWriter;
  friend std::optional<std::string> noted_metadata(const ImageReader& reader, const std::string& name);
  struct State;  // image_library.hpp
  std::unique_ptr<State> state_;
};

using Metadata = std::vector<std::pair<std::string, std::string>>;  // name and text

// What shall differ from the image that a new one follows.
struct ImageChanges {
  std::optional<PixelType> type;                     // of all channels
  std::optional<std::vector<std::string>> channels;  // other channels, all of the type of the first
  std::optional<Transfer> transfer;                  // the values follow no curve, whatever the model's do
  Metadata metadata;                                 // to add; TIFF and JPEG keep it in the tag Software
};

// What an earlier run noted as its metadata under `name`, in the file itself or in its tag Software.
std::optional<std::string> noted_metadata(const ImageReader& reader, const std::string& name);

// One part of a new image: it follows a part of another in everything but `changes`.
struct ImagePart {
  const ImageReader* model = nullptr;  // only looked at by the constructor below
  ImageChanges changes;
};

// Writes an image whose parts follow others: in pixel types, compression, tiling, channel names, metadata and
// windows, as far as the format (chosen by the extension of `path`) can hold them; in mip levels where the
// format has them. Works under a name of its own beside `path`. Every failure is Error kOutput and names
// `path`: a full disk, too.
class ImageWriter {
 public:
  ImageWriter(const std::filesystem::path& path, const std::vector<ImagePart>& parts);
  ~ImageWriter();  // takes away what was not committed
  ImageWriter(ImageWriter&&) noexcept;
  ImageWriter& operator=(ImageWriter&&) noexcept;

  const std::filesystem::path& path() const noexcept;
  const ImageLayout& layout() const noexcept;  // of the plane that is written
  int level_count(int part) const noexcept;
  ImageLayout layout(int part) const;  // of its level 0

  // Goes on with another plane: all levels of a part, the largest first, then the next part. The plane before
  // has been written whole. At first it is level 0 of part 0.
  void select(int part, int level);

  // The next rows, from the top; rules as in ImageReader::read_rows.
  void write_rows(int first_row, int row_count, const std::byte* texels);

  // Closes the file and checks it: afterwards every byte has been taken by the system.
  void finish();

  // Gives the finished file its final name, replacing what was there.
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace remap
