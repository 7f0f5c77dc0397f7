#include "sweep/image_file.hpp"

#include <array>
#include <vector>

#include <OpenImageIO/imageio.h>

#include "error.hpp"
#include "files.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

// Places of red, green and blue: by name, else the first three; the only channel for all of them.
std::array<int, 3> colour_channels(const OIIO::ImageSpec& spec, const std::filesystem::path& path) {
  if (spec.nchannels == 1) return {0, 0, 0};
  const std::array<int, 3> named = {spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B")};
  if (named[0] >= 0 && named[1] >= 0 && named[2] >= 0) return named;
  if (spec.nchannels >= 3) return {0, 1, 2};
  throw Error(ErrorKind::kInput, path.string() + ": has 2 channels; expected R, G, B or one");
}

}  // namespace

Image read_rgb(const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& reason) {
    throw Error(ErrorKind::kInput, path.string() + ": cannot be read: " + reason);
  };
  if (std::error_code failure; !std::filesystem::is_regular_file(path, failure))
    refuse(failure ? failure.message() : "is no file");
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input) refuse(OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  const std::array<int, 3> channels = colour_channels(spec, path);
  const auto count = static_cast<std::size_t>(spec.nchannels);
  std::vector<float> values(spec.image_pixels() * count);
  // A file that was cut off may be read "successfully": only the pending message tells.
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
               const std::map<std::string, std::string>& attributes) {
  if (path.extension() != ".exr")
    throw Error(ErrorKind::kUsage, path.string() + ": has not the extension .exr; expected an OpenEXR file");
  remap::create_parent(path);
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT);
  if (image.channels == 1) spec.channelnames = {"Y"};
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  for (const auto& [key, value] : attributes) spec.attribute(key, value);

  const std::filesystem::path unfinished = remap::unfinished_name(path);
  const auto output = OIIO::ImageOutput::create(unfinished.string());
  const bool written = output && output->open(unfinished.string(), spec) &&
                       output->write_image(OIIO::TypeDesc::FLOAT, image.values.data()) && output->close();
  if (!written) {
    const std::string reason = output ? output->geterror() : OIIO::geterror();
    std::error_code ignored;
    std::filesystem::remove(unfinished, ignored);
    throw Error(ErrorKind::kOutput, path.string() + ": cannot be written: " + reason);
  }
  remap::commit_file(unfinished, path);
}

}  // namespace remapc
