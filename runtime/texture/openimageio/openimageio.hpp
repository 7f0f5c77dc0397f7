// This header belongs to the files of the image module. Only these files include OpenImageIO.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>

#include "assets/document/image_codec.hpp"
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

}  // namespace remap
