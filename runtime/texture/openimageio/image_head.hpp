// This file checks the head of an image before OpenImageIO reads it. OpenImageIO trusts headers, and with
// some formats reads beyond its memory. So every image passes through here, from files, assets, strokes and
// workers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <OpenImageIO/imageio.h>

namespace remap {

// An ImageBytes gives the bytes of an image from a file or from memory.
struct ImageBytes {
  std::uint64_t size = 0;
  // Reads up to `count` bytes that begin at `place`. Returns how many bytes the file had there.
  std::function<std::size_t(std::uint64_t place, char* bytes, std::size_t count)> read;
};
ImageBytes bytes_of(std::string_view memory);

struct ImageHead {
  std::string format;                   // name of the format in OpenImageIO
  std::vector<std::string> png_chunks;  // names of the chunks before the pixels
  bool is_read_whole = false;           // reading one row needs the memory of all rows
};

// An image in memory belongs to an asset, which allows fewer formats.
enum class ImageUse { kMap, kAsset };

// Detects the format by the content, not by the name. Formats are PNG, JPEG, WebP, BMP, TIFF, Targa, OpenEXR
// and Radiance HDR. Throws kInput, beginning with `context`, for other content, and for a header that would
// harm OpenImageIO.
ImageHead checked_head(const ImageBytes& image, const std::string& context, ImageUse use = ImageUse::kMap);

// Throws kInput, beginning with `context`, if the file is too small for its picture, or if the picture needs
// more memory than set_image_memory() allows.
void require_plausible(const OIIO::ImageSpec& spec, const ImageHead& head, const ImageBytes& image,
                       const std::string& context);

// Limits the bytes that the texels of one image may take in memory at once.
void set_image_memory(std::uint64_t bytes);
void require_image_memory(std::uint64_t bytes, const std::string& context);

}  // namespace remap
