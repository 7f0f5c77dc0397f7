// Images in memory, as assets embed them.
#include <webp/decode.h>

#include <OpenImageIO/filesystem.h>

#include "assets/image_codec.hpp"
#include "core/errors.hpp"
#include "core/files.hpp"
#include "core/scratch_folder.hpp"
#include "texture/openimageio/openimageio.hpp"

namespace remap {
namespace {

// An image says its size before its texels are read. More is a mistake or an attack.
constexpr std::uint64_t kMostTexels = std::uint64_t{1} << 30;

constexpr int kNoPngFilter = 8;  // PNG_FILTER_NONE of libpng

std::string_view part_of(std::string_view bytes, std::size_t begin, std::size_t count) {
  return bytes.size() < begin ? std::string_view() : bytes.substr(begin, count);
}

// Targa files do not begin with a mark: their header of 18 bytes is one that a writer of images makes.
bool is_targa(std::string_view bytes) {
  if (bytes.size() <= 18) return false;
  const std::string_view types("\1\2\3\11\12\13", 6), depths("\10\17\20\30\40", 5);
  return (bytes[1] == 0 || bytes[1] == 1) && types.find(bytes[2]) != std::string_view::npos &&
         depths.find(bytes[16]) != std::string_view::npos;
}

// The extension of the formats that glTF files hold, and of those that OBJ files name; empty for others.
std::string extension_of(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return "png";
  if (bytes.starts_with("\xff\xd8")) return "jpg";
  if (bytes.starts_with("RIFF") && part_of(bytes, 8, 4) == "WEBP") return "webp";
  if (bytes.starts_with("BM")) return "bmp";
  if (bytes.starts_with(std::string_view("II*\0", 4)) || bytes.starts_with(std::string_view("MM\0*", 4)))
    return "tif";
  return is_targa(bytes) ? "tga" : "";
}

std::string known_name(std::string_view bytes) {
  if (bytes.starts_with("\xabKTX")) return "KTX2";
  if (part_of(bytes, 4, 8) == "ftypavif") return "AVIF";
  if (bytes.starts_with("DDS ")) return "DDS";
  return "";
}

// By libwebp itself: OpenImageIO 2.4 multiplies the colors by alpha in 8 bits, whatever it is asked for.
ImagePixels webp_pixels(std::string_view bytes, const std::string& place) {
  const auto* const data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  WebPBitstreamFeatures features;
  bool is_read = WebPGetFeatures(data, bytes.size(), &features) == VP8_STATUS_OK;
  ImagePixels pixels;
  if (is_read) {
    pixels.width = static_cast<std::size_t>(features.width);
    pixels.height = static_cast<std::size_t>(features.height);
    pixels.channels = features.has_alpha != 0 ? 4 : 3;
    const std::size_t row = pixels.width * pixels.channels;
    pixels.bytes.resize(row * pixels.height);
    const auto decode = pixels.has_alpha() ? &WebPDecodeRGBAInto : &WebPDecodeRGBInto;
    is_read = decode(data, bytes.size(), reinterpret_cast<std::uint8_t*>(pixels.bytes.data()),
                     pixels.bytes.size(), static_cast<int>(row)) != nullptr;
  }
  if (!is_read)
    throw input_error(place + ": cannot be read: the image is damaged, or an animation (convert it to PNG)");
  return pixels;
}

class AssetCodec final : public ImageCodec {
 public:
  ImagePixels decode(std::string_view bytes, const std::string& place) const override {
    const std::string extension = extension_of(bytes);
    if (extension.empty()) {
      const std::string name = known_name(bytes);
      throw input_error(place + ": " +
                        (name.empty()
                             ? "is no image of a known format (PNG, JPEG, WebP, BMP, TIFF and Targa are read)"
                             : "is " + name + ", which is not read (convert it to PNG)"));
    }
    if (extension == "webp") return webp_pixels(bytes, place);
    OIIO::ImageSpec config;
    config.attribute(kUnassociatedAlpha, 1);
    OIIO::Filesystem::IOMemReader memory(const_cast<char*>(bytes.data()), bytes.size());
    const std::string name = "memory." + extension;
    auto input = OIIO::ImageInput::create(name);
    if (input && input->supports("ioproxy")) {
      input = OIIO::ImageInput::open(name, &config, &memory);
      return pixels_of(input.get(), place);
    }
    const ScratchFolder folder("texremap-image");
    const std::string file = folder.file(name);
    write_file(file, bytes, Flush::kNo);
    input = OIIO::ImageInput::open(file, &config);
    return pixels_of(input.get(), place);
  }

  std::string encode_png(const ImagePixels& pixels, int level) const override {
    OIIO::ImageSpec spec = spec_of(pixels);
    spec.attribute("png:compressionLevel", level);
    std::string bytes = encoded(pixels, spec, "png");
    if (level < kSmallestPngLevel) return bytes;
    // Images of few values are smaller without filters.
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

  static ImagePixels pixels_of(OIIO::ImageInput* input, const std::string& place) {
    const auto refuse = [&](const std::string& reason) {
      throw input_error(place + ": cannot be read: " + first_line(reason, "the image is damaged"));
    };
    if (input == nullptr) refuse(OIIO::geterror());
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.width <= 0 || spec.height <= 0 || spec.image_pixels() > kMostTexels || spec.nchannels < 1 ||
        spec.nchannels > 4)
      refuse("its size or its number of channels is none of an image of an asset");
    ImagePixels pixels;
    pixels.width = static_cast<std::size_t>(spec.width);
    pixels.height = static_cast<std::size_t>(spec.height);
    pixels.channels = static_cast<std::size_t>(spec.nchannels);
    const bool is_wide = spec.format.basesize() > 1;
    pixels.type = is_wide ? PixelType::kUint16 : PixelType::kUint8;
    pixels.bytes.resize(pixels.width * pixels.height * pixels.texel_bytes());
    // OpenImageIO may read a truncated file without failing; only the pending error message shows it.
    if (!input->read_image(0, 0, 0, spec.nchannels, is_wide ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8,
                           pixels.bytes.data()) ||
        input->has_error())
      refuse(input->geterror());
    return pixels;
  }
};

}  // namespace

const ImageCodec& asset_codec() {
  static const AssetCodec codec;
  return codec;
}

}  // namespace remap
