// This file reads and writes images in memory, for images inside of assets, and whole pictures as floats.

#include <webp/decode.h>

#include <OpenImageIO/filesystem.h>

#include "assets/document/asset.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "texture/openimageio/openimageio.hpp"

namespace remap {
namespace {

// A conversion keeps this many copies of the pixels of an image, for other maps of the material and for
// results.
constexpr std::uint64_t kCopies = 4;

constexpr int kNoPngFilter = 8;  // PNG_FILTER_NONE of libpng

// Uses libwebp directly, because OpenImageIO 2.4 always multiplies the colors by alpha in 8 bits.
ImagePixels webp_pixels(std::string_view bytes, const ImageHead& head, const std::string& context) {
  const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  WebPBitstreamFeatures features;
  bool is_read = WebPGetFeatures(data, bytes.size(), &features) == VP8_STATUS_OK;
  ImagePixels pixels;
  if (is_read) {
    pixels.width = static_cast<std::size_t>(features.width);
    pixels.height = static_cast<std::size_t>(features.height);
    pixels.channels = features.has_alpha != 0 ? 4 : 3;
    const std::size_t row = pixels.width * pixels.channels;
    require_plausible(OIIO::ImageSpec(features.width, features.height, static_cast<int>(pixels.channels)),
                      head, bytes_of(bytes), context);
    require_image_memory(kCopies * row * pixels.height, context);
    pixels.bytes.resize(row * pixels.height);
    const auto decode = pixels.has_alpha() ? &WebPDecodeRGBAInto : &WebPDecodeRGBInto;
    is_read = decode(data, bytes.size(), reinterpret_cast<std::uint8_t*>(pixels.bytes.data()),
                     pixels.bytes.size(), static_cast<int>(row)) != nullptr;
  }
  if (!is_read)
    throw input_error(context +
                      ": cannot be read: the image is damaged, or an animation (convert it to PNG)");
  return pixels;
}

class AssetCodec final : public ImageCodec {
 public:
  ImagePixels decode(std::string_view bytes, const std::string& context) const override {
    const ImageBytes image = bytes_of(bytes);
    const ImageHead head = checked_head(image, context, ImageUse::kAsset);
    if (head.format == "webp") return webp_pixels(bytes, head, context);
    OIIO::ImageSpec config, ignored;
    config.attribute(kUnassociatedAlpha, 1);
    OIIO::Filesystem::IOMemReader memory(const_cast<char*>(bytes.data()), bytes.size());
    const auto input = OIIO::ImageInput::create(head.format, false);
    if (!input || !input->set_ioproxy(&memory) || !input->open("image", ignored, config)) {
      std::string reason = input ? input->geterror() : "";
      if (reason.empty()) reason = OIIO::geterror();
      throw input_error(context + ": cannot be read: " + first_line(reason, "the image is damaged"));
    }
    require_plausible(input->spec(), head, image, context);
    return pixels_of(*input, context);
  }

  std::string encode_png(const ImagePixels& pixels, int level) const override {
    OIIO::ImageSpec spec = spec_of(pixels);
    spec.attribute("png:compressionLevel", level);
    std::string bytes = encoded(pixels, spec, "png");
    if (level < kSmallestPngLevel) return bytes;
    // Images with few different values are smaller without filters.
    spec.attribute("png:filter", kNoPngFilter);
    std::string other = encoded(pixels, spec, "png");
    return other.size() < bytes.size() ? other : bytes;
  }

  std::string encode_jpeg(const ImagePixels& pixels, int quality) const override {
    OIIO::ImageSpec spec = spec_of(pixels);
    spec.attribute("CompressionQuality", quality);
    return encoded(pixels, spec, "jpg");
  }

 private:
  static OIIO::ImageSpec spec_of(const ImagePixels& pixels) {
    OIIO::ImageSpec spec(static_cast<int>(pixels.width), static_cast<int>(pixels.height),
                         static_cast<int>(pixels.channels),
                         pixels.type == PixelType::kUint16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8);
    spec.attribute(kUnassociatedAlpha, 1);
    return spec;
  }

  static std::string encoded(const ImagePixels& pixels, const OIIO::ImageSpec& spec,
                             const std::string& extension) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const std::string name = "memory." + extension;
    const auto output = OIIO::ImageOutput::create(name, &memory);
    if (!output || !output->open(name, spec) || !output->write_image(spec.format, pixels.bytes.data()) ||
        !output->close())
      throw output_error(extension +
                         " image: cannot be encoded: " + (output ? output->geterror() : OIIO::geterror()));
    return {bytes.begin(), bytes.end()};
  }

  static ImagePixels pixels_of(OIIO::ImageInput& input, const std::string& context) {
    const auto refuse = [&](const std::string& reason) {
      throw input_error(context + ": cannot be read: " + first_line(reason, "the image is damaged"));
    };
    const OIIO::ImageSpec& spec = input.spec();
    if (spec.width <= 0 || spec.height <= 0 || spec.nchannels < 1 || spec.nchannels > 4)
      refuse("its size or its number of channels is invalid for an asset (1 to 4 channels are allowed)");
    ImagePixels pixels;
    pixels.width = static_cast<std::size_t>(spec.width);
    pixels.height = static_cast<std::size_t>(spec.height);
    pixels.channels = static_cast<std::size_t>(spec.nchannels);
    const bool is_wide = spec.format.basesize() > 1;
    pixels.type = is_wide ? PixelType::kUint16 : PixelType::kUint8;
    const std::size_t size = pixels.width * pixels.height * pixels.texel_bytes();
    require_image_memory(kCopies * size, context);
    pixels.bytes.resize(size);
    // OpenImageIO may read a truncated file without failing; only the pending error message shows it.
    if (!input.read_image(0, 0, 0, spec.nchannels, is_wide ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8,
                          pixels.bytes.data()) ||
        input.has_error())
      refuse(input.geterror());
    return pixels;
  }
};

}  // namespace

const ImageCodec& asset_codec() {
  static const AssetCodec codec;
  return codec;
}

namespace fs = std::filesystem;
namespace {

OIIO::ImageSpec spec_of(const Picture& picture, OIIO::TypeDesc type) {
  OIIO::ImageSpec spec(picture.width, picture.height, static_cast<int>(picture.channels.size()), type);
  spec.channelnames = picture.channels;
  return spec;
}

std::string encoded(const Picture& picture, const OIIO::ImageSpec& spec, const std::string& name) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(name);
  if (!output || !output->set_ioproxy(&memory) || !output->open(name, spec) ||
      !output->write_image(OIIO::TypeDesc::FLOAT, picture.values.data()) || !output->close())
    throw output_error(name + ": cannot be encoded: " + (output ? output->geterror() : OIIO::geterror()));
  return {bytes.begin(), bytes.end()};
}

}  // namespace

Picture read_picture(const fs::path& path) {
  const auto refuse = [&](const std::string& reason) {
    throw input_error(path.string() + ": cannot be read: " + reason);
  };
  const auto file = std::make_shared<const InputFile>(path);
  const ImageBytes bytes{file->size(), [&](std::uint64_t place, char* into, std::size_t count) {
                           return file->read(place, into, count);
                         }};
  const ImageHead head = checked_head(bytes, path.string());
  const auto input = OIIO::ImageInput::create(head.format, false);
  OIIO::ImageSpec spec;
  if (!input || !input->open(path.string(), spec)) refuse(input ? input->geterror() : OIIO::geterror());
  require_plausible(spec, head, bytes, path.string());
  require_image_memory(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels) * sizeof(float),
                       path.string());
  Picture picture{spec.width, spec.height, spec.channelnames, {}};
  picture.values.resize(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  // OpenImageIO may read a truncated file without failing; only the pending error message shows it.
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, picture.values.data()) ||
      input->has_error())
    refuse(input->geterror());
  return picture;
}

void write_exr_picture(const fs::path& path, const Picture& picture,
                       const std::map<std::string, std::string>& attributes) {
  OIIO::ImageSpec spec = spec_of(picture, OIIO::TypeDesc::FLOAT);
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  for (const auto& [key, value] : attributes) spec.attribute(key, value);
  write_file(path, encoded(picture, spec, path.filename().string()));
}

void write_png_picture(const fs::path& path, const Picture& picture) {
  write_file(path, png_picture_bytes(picture));
}

std::string png_picture_bytes(const Picture& picture) {
  return encoded(picture, spec_of(picture, OIIO::TypeDesc::UINT8), "picture.png");
}

}  // namespace remap
