#include "warp/input/stroke_image.hpp"

#include "remap/error.hpp"
#include "texture/image_io.hpp"
#include "warp/input/image_texels.hpp"

namespace remapc {

using remap::Error;
using remap::ErrorKind;

std::string size_text(std::size_t width, std::size_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

void read_stroke_image(const std::filesystem::path& image, const MapFrame& material,
                       const StrokeChannel& use) {
  remap::ImageReader reader(image);
  const remap::ImageLayout& layout = reader.layout();
  const auto width = static_cast<std::size_t>(layout.width), height = static_cast<std::size_t>(layout.height);
  if (width != material.width || height != material.height)
    throw Error(ErrorKind::kInput, image.string() + ": size " + size_text(width, height) +
                                       " does not match the maps of " + material.name + " (" +
                                       size_text(material.width, material.height) + ")");
  const std::vector<std::byte> texels = texels_of(reader);
  std::vector<float> values(width * height);
  for (std::size_t c = 0; c < layout.channels.size(); ++c) {
    const remap::Channel& channel = layout.channels[c];
    remap::load_values(channel.type, texels.data() + channel.offset, layout.texel_bytes, values.size(),
                       values.data());
    use(values, static_cast<int>(c) == layout.alpha_channel);
  }
}

void require_background(const std::filesystem::path& image, std::size_t marked, const MapFrame& material) {
  if (4 * marked > 3 * material.width * material.height)
    throw Error(ErrorKind::kInput, image.string() +
                                       ": strokes cover more than three quarters of the image (check whether "
                                       "it is inverted)");
}

}  // namespace remapc
