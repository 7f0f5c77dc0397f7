#include "renderer/image_file.hpp"

#include <array>
#include <functional>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "remap/error.hpp"
#include "system/files.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

// Finds red, green and blue: by name, else the first three channels; a single channel serves as all three.
std::array<int, 3> color_channels(const OIIO::ImageSpec& spec, const std::filesystem::path& path) {
  if (spec.nchannels == 1) return {0, 0, 0};
  const std::array<int, 3> named = {spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B")};
  if (named[0] >= 0 && named[1] >= 0 && named[2] >= 0) return named;
  if (spec.nchannels >= 3) return {0, 1, 2};
  throw Error(ErrorKind::kInput, path.string() + ": 2 channels found (provide R, G, B or one channel)");
}

void require_extension(const std::filesystem::path& path, const std::string& extension,
                       const std::string& expected) {
  if (path.extension() != extension)
    throw Error(ErrorKind::kUsage,
                path.string() + ": the extension must be " + extension + " (" + expected + ")");
}

// Writes to a temporary name, lets `is_whole` check that file, then renames it.
void write_picture(const std::filesystem::path& path, const Image& image, const OIIO::ImageSpec& spec,
                   const std::function<bool(const std::filesystem::path&)>& is_whole) {
  remap::create_parent(path);
  const std::filesystem::path unfinished = remap::unfinished_name(path);
  const auto output = OIIO::ImageOutput::create(unfinished.string());
  const bool written = output && output->open(unfinished.string(), spec) &&
                       output->write_image(OIIO::TypeDesc::FLOAT, image.values.data()) && output->close();
  if (!written || !is_whole(unfinished)) {
    std::string reason = output ? output->geterror() : OIIO::geterror();
    if (reason.empty()) reason = "the file is incomplete";
    std::error_code ignored;
    std::filesystem::remove(unfinished, ignored);
    throw Error(ErrorKind::kOutput,
                path.string() + ": cannot be written: " + remap::with_final_name(reason, unfinished, path));
  }
  remap::commit_file(unfinished, path);
}

}  // namespace

Image read_rgb(const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& reason) {
    throw Error(ErrorKind::kInput, path.string() + ": cannot be read: " + reason);
  };
  remap::require_regular_file(path);
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input) refuse(OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  const std::array<int, 3> channels = color_channels(spec, path);
  const auto count = static_cast<std::size_t>(spec.nchannels);
  std::vector<float> values(spec.image_pixels() * count);
  // OpenImageIO may read a truncated file without failing; only the pending error message shows it.
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()) || input->has_error())
    refuse(input->geterror());
  Image image{spec.width, spec.height, 3, {}};
  image.values.reserve(3 * spec.image_pixels());
  for (std::size_t start = 0; start < values.size(); start += count)
    for (const int channel : channels)
      image.values.push_back(values[start + static_cast<std::size_t>(channel)]);
  return image;
}

void write_exr(const std::filesystem::path& path, const Image& image,
               const std::map<std::string, std::string>& attributes,
               const std::vector<std::string>& channels) {
  require_extension(path, ".exr", "an OpenEXR file");
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT);
  if (image.channels == 1) spec.channelnames = {"Y"};
  if (!channels.empty()) spec.channelnames = channels;
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  for (const auto& [key, value] : attributes) spec.attribute(key, value);
  write_picture(path, image, spec, [](const std::filesystem::path&) { return true; });
}

void write_png(const std::filesystem::path& path, const Image& image) {
  require_extension(path, ".png", "a PNG file");
  const OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
  // OpenImageIO's PNG writer does not report a full disk, so the file is read back before it is renamed.
  write_picture(path, image, spec, [&](const std::filesystem::path& unfinished) {
    const auto input = OIIO::ImageInput::open(unfinished.string());
    std::vector<unsigned char> bytes(image.values.size());
    return input && input->spec().image_bytes() == bytes.size() &&
           input->read_image(0, 0, 0, image.channels, OIIO::TypeDesc::UINT8, bytes.data()) &&
           !input->has_error();
  });
}

std::string png_bytes(const Image& image) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
  const auto output = OIIO::ImageOutput::create("memory.png", &memory);
  if (!output || !output->open("memory.png", spec) ||
      !output->write_image(OIIO::TypeDesc::FLOAT, image.values.data()) || !output->close())
    throw Error(ErrorKind::kOutput,
                "PNG image: cannot be encoded: " + (output ? output->geterror() : OIIO::geterror()));
  return {bytes.begin(), bytes.end()};
}

}  // namespace remapc
