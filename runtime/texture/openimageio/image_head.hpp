// What an image says of itself before a reader of OpenImageIO sees it: every image passes here, of files, of
// assets, of strokes and of workers. Its readers believe what headers claim, and some of them read beyond
// their memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <OpenImageIO/imageio.h>

namespace remap {

// The bytes of an image: of a file or of memory.
struct ImageBytes {
  std::uint64_t size = 0;
  // Reads up to `count` bytes from `context` on; returns how many there were.
  std::function<std::size_t(std::uint64_t place, char* bytes, std::size_t count)> read;
};
ImageBytes bytes_of(std::string_view memory);

struct ImageHead {
  std::string format;                   // as OpenImageIO names its reader
  std::vector<std::string> png_chunks;  // names of those before the pixels
  bool is_read_whole = false;           // for one row of it the reader takes the memory of all
};

// An image in memory is one of an asset, which holds fewer formats.
enum class ImageUse { kMap, kAsset };

// By the content, whatever the name: PNG, JPEG, WebP, BMP, TIFF, Targa, OpenEXR and Radiance HDR. Throws
// kInput, beginning with `context`, for every other content, and for a header that would harm a reader.
ImageHead checked_head(const ImageBytes& image, const std::string& context, ImageUse use = ImageUse::kMap);

// Throws kInput, beginning with `context`, for a picture that its file is too small for, and for one that
// takes more than the memory of set_image_memory().
void require_plausible(const OIIO::ImageSpec& spec, const ImageHead& head, const ImageBytes& image,
                       const std::string& context);

// The most bytes that the texels of one image may take in memory at once.
void set_image_memory(std::uint64_t bytes);
void require_image_memory(std::uint64_t bytes, const std::string& context);

}  // namespace remap
