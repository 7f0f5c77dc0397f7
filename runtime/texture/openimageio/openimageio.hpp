// This header belongs to the files of the image module. Only these files include OpenImageIO. OpenImageIO
// trusts headers, and with some formats reads beyond its memory. So the head of every image is checked
// before, from files, assets, strokes and workers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <OpenImageIO/imageio.h>

#include "assets/document/asset.hpp"
#include "texture/image_library.hpp"

namespace remap {

// This attribute stops OpenImageIO from multiplying or dividing colors by alpha, because maps hold data.
inline constexpr const char* kUnassociatedAlpha = "oiio:UnassociatedAlpha";

// Returns the first line of a message of OpenImageIO, or `otherwise` if the message is empty.
std::string first_line(const std::string& text, const std::string& otherwise);

// This tag marks results with linear colors in integers, if their format has no tag for that.
inline constexpr const char* kNotedColorSpace = "remap:color_space";

// Returns the metadata that an earlier run wrote under `name`, as an attribute or in the tag Software.
std::optional<std::string> noted_metadata(const OIIO::ImageSpec& spec, const std::string& name);

// Returns the type for reading and writing rows without a conversion. If channels have several types, this
// must be TypeUnknown. With TypeUnknown, the TIFF writer of OpenImageIO 2.4 makes errors at the right and
// lower edge of tiled images.
OIIO::TypeDesc native_type(const OIIO::ImageSpec& spec);

// Returns nothing for types that images cannot have here.
std::optional<PixelType> pixel_type(OIIO::TypeDesc type);

// layout_of() throws kInput if the type of a channel is not supported. has_compression_level() returns true
// for PNG, and for zip in EXR and TIFF.
bool has_compression_level(const OIIO::ImageSpec& spec, const std::string& format);

ImageLayout layout_of(const OIIO::ImageSpec& spec, const std::string& format,
                      const std::filesystem::path& path);

std::unique_ptr<StoredImage> open_image(const std::shared_ptr<const InputFile>& file, int part);
std::unique_ptr<NewImage> create_image(const std::filesystem::path& path, const std::vector<NewPart>& parts);

// Returns the descriptions of all levels of a stored image. A new image that is made from it gets the same
// levels.
const std::vector<OIIO::ImageSpec>& followed_levels(const StoredImage& image);

Picture read_picture(const std::filesystem::path& path);
void write_exr_picture(const std::filesystem::path& path, const Picture& picture,
                       const std::map<std::string, std::string>& attributes);
void write_png_picture(const std::filesystem::path& path, const Picture& picture);
std::string png_picture_bytes(const Picture& picture);

const ImageCodec& asset_codec();

// Returns the description of a new file that equals `model` in everything except `changes`, as far as the
// format of `output` allows. Throws kOutput, with `path`, if the format cannot hold the channels or their
// type.
OIIO::ImageSpec output_spec(const OIIO::ImageSpec& model, const std::string& model_format,
                            const OIIO::ImageOutput& output, const ImageChanges& changes,
                            const std::filesystem::path& path);

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
