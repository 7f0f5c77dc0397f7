#include "warp/stroke_masks.hpp"

#include <sstream>

#include "error.hpp"
#include "number_text.hpp"
#include "texture/image_io.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;

std::string size_text(std::size_t width, std::size_t height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

}  // namespace

std::vector<std::uint32_t> read_stroke(const std::filesystem::path& mask, const TextureMaterial& material) {
  remap::ImageReader reader(mask);
  const remap::ImageLayout& layout = reader.layout();
  const auto width = static_cast<std::size_t>(layout.width), height = static_cast<std::size_t>(layout.height);
  if (width != material.width || height != material.height)
    throw Error(ErrorKind::kInput, mask.string() + ": is " + size_text(width, height) + "; expected " +
                                       size_text(material.width, material.height) +
                                       ", the size of the maps in " + material.material.name);
  std::vector<std::byte> texels(height * layout.row_bytes());
  reader.read_rows(0, layout.height, texels.data());
  std::vector<float> values(width * height);
  std::vector<char> marked(values.size(), 0);
  for (std::size_t c = 0; c < layout.channels.size(); ++c) {
    const remap::Channel& channel = layout.channels[c];
    if (static_cast<int>(c) == layout.alpha_channel) continue;
    remap::load_values(channel.type, texels.data() + channel.offset, layout.texel_bytes, values.size(),
                       values.data());
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] > 0.5f) marked[i] = 1;
  }
  std::vector<std::uint32_t> stroke;
  for (std::uint32_t i = 0; i < marked.size(); ++i)
    if (marked[i] != 0) stroke.push_back(i);
  if (stroke.empty())
    throw Error(ErrorKind::kInput, mask.string() + ": marks no texel; expected some above half of white");
  if (4 * stroke.size() > 3 * marked.size())
    throw Error(ErrorKind::kInput, mask.string() +
                                       ": marks more than three quarters of all texels; expected white "
                                       "strokes on black (is it inverted?)");
  return stroke;
}

std::vector<std::uint32_t> box_stroke(const std::string& box, const TextureMaterial& material) {
  const auto fail = [&] {
    throw Error(ErrorKind::kUsage, "--box: is " + box + "; expected x0,y0,x1,y1 within " +
                                       size_text(material.width, material.height) +
                                       " texels, x0 below x1 and y0 "
                                       "below y1");
  };
  std::vector<std::size_t> corner;
  std::istringstream parts(box);
  for (std::string part; std::getline(parts, part, ',');) {
    const auto number = remap::parse_number(part);
    if (!number || *number < 0.0 || *number > 1e6) fail();
    corner.push_back(static_cast<std::size_t>(*number));
  }
  if (corner.size() != 4 || corner[0] >= corner[2] || corner[1] >= corner[3] || corner[2] > material.width ||
      corner[3] > material.height)
    fail();
  std::vector<std::uint32_t> stroke;
  for (std::size_t y = corner[1]; y < corner[3]; ++y)
    for (std::size_t x = corner[0]; x < corner[2]; ++x)
      stroke.push_back(static_cast<std::uint32_t>(y * material.width + x));
  return stroke;
}

}  // namespace remapc
