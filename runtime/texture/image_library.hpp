// Shared by the reader and the writer of images: the only header that includes OpenImageIO. Private to
// image_reader.cpp, image_writer.cpp and output_spec.cpp.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>

#include "texture/image_io.hpp"
#include "texture/resampled_rows.hpp"

namespace remap {

// The attribute that stops OpenImageIO from multiplying or dividing colors by alpha, because maps hold data.
inline constexpr const char* kUnassociatedAlpha = "oiio:UnassociatedAlpha";

// The first line of a message of OpenImageIO, or `otherwise` if the message is empty.
std::string first_line(const std::string& text, const std::string& otherwise);

// The note of results whose format has no tag for linear colors in whole numbers.
inline constexpr const char* kNotedColorSpace = "remap:color_space";

// The metadata that an earlier run wrote under `name`, as an attribute or in the tag Software.
std::optional<std::string> noted_metadata(const OIIO::ImageSpec& spec, const std::string& name);

// The type for passing rows without conversion. Channels of several types need TypeUnknown, which the TIFF
// writer of OpenImageIO 2.4 gets wrong at the right and lower edge of tiled images.
OIIO::TypeDesc native_type(const OIIO::ImageSpec& spec);

// Throws kInput if a channel has an unsupported type.
ImageLayout layout_of(const OIIO::ImageSpec& spec, const std::string& format,
                      const std::filesystem::path& path);

struct ImageReader::State {
  std::filesystem::path path;
  std::unique_ptr<OIIO::ImageInput> input;
  int part = 0;
  int part_count = 0;
  int level = 0;
  std::vector<OIIO::ImageSpec> levels;  // of the levels of the part, at the size of reading
  ImageLayout layout;                   // of `level`
  std::unique_ptr<ResampledRows> resampled;

  const OIIO::ImageSpec& spec() const { return levels[static_cast<std::size_t>(level)]; }
  void open();
  void find_planes();
  // Reads rows at the size of the file.
  void read_rows(int first_row, int row_count, std::byte* texels);
  [[noreturn]] void fail(const std::string& what) const;
};

// The description of a new file that follows `model` in everything except `changes`, as far as the format of
// `output` can hold it. Throws kOutput, naming `path`, if it cannot hold the channels or the requested type.
OIIO::ImageSpec output_spec(const OIIO::ImageSpec& model, const std::string& model_format,
                            const OIIO::ImageOutput& output, const ImageChanges& changes,
                            const std::filesystem::path& path);

}  // namespace remap
