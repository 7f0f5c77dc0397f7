#include "look/image.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "core/input_file.hpp"
#include "remap/error.hpp"
#include "texture/image_library.hpp"

namespace remap {
namespace {

// Finds red, green and blue by name, otherwise the first three channels. A single channel is all three.
std::array<std::size_t, 3> color_channels(const std::vector<std::string>& names,
                                          const std::filesystem::path& path) {
  if (names.size() == 1) return {0, 0, 0};
  std::array<std::size_t, 3> named{};
  for (std::size_t c = 0; c < named.size(); ++c)
    named[c] = static_cast<std::size_t>(std::find(names.begin(), names.end(), std::string(1, "RGB"[c])) -
                                        names.begin());
  if (std::find(named.begin(), named.end(), names.size()) == named.end()) return named;
  if (names.size() >= 3) return {0, 1, 2};
  throw Error(ErrorKind::kInput, path.string() + ": 2 channels found (provide R, G, B or one channel)");
}

void require_extension(const std::filesystem::path& path, const std::string& extension,
                       const std::string& expected) {
  if (path.extension() != extension)
    throw Error(ErrorKind::kUsage,
                path.string() + ": the extension must be " + extension + " (" + expected + ")");
}

// `channels` are names. If it is empty, one channel is Y and three are R, G, B.
Picture picture_of(const Image& image, const std::vector<std::string>& channels = {}) {
  const std::vector<std::string> usual =
      image.channels == 1 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  return {image.width, image.height, channels.empty() ? usual : channels, image.values};
}

}  // namespace

Image read_rgb(const std::filesystem::path& path) {
  require_regular_file(path);
  const Picture picture = image_library().read_picture(path);
  const std::array<std::size_t, 3> channels = color_channels(picture.channels, path);
  Image image{picture.width, picture.height, 3, {}};
  const std::size_t count = picture.channels.size();
  image.values.reserve(picture.values.size() / count * 3);
  for (std::size_t start = 0; start < picture.values.size(); start += count)
    for (const std::size_t channel : channels) image.values.push_back(picture.values[start + channel]);
  return image;
}

void write_exr(const std::filesystem::path& path, const Image& image,
               const std::map<std::string, std::string>& attributes,
               const std::vector<std::string>& channels) {
  require_extension(path, ".exr", "an OpenEXR file");
  image_library().write_exr(path, picture_of(image, channels), attributes);
}

void write_png(const std::filesystem::path& path, const Image& image) {
  require_extension(path, ".png", "a PNG file");
  image_library().write_png(path, picture_of(image));
}

std::string png_bytes(const Image& image) { return image_library().png_bytes(picture_of(image)); }

}  // namespace remap
