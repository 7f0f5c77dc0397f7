// This file reads strokes from masks and boxes, and images of strokes.
#include "warp/strokes.hpp"

#include <sstream>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "warp/image_texels.hpp"

namespace remap {
namespace {

// Returns for example `96x64`.
std::string size_text(std::size_t width, std::size_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace

void read_stroke_image(const std::filesystem::path& image, const MaterialRef& material,
                       const StrokeChannel& use) {
  ImageReader reader(image);
  const ImageLayout& layout = reader.layout();
  const auto width = static_cast<std::size_t>(layout.width), height = static_cast<std::size_t>(layout.height);
  if (width != material.width() || height != material.height())
    throw input_error(image.string() + ": size " + size_text(width, height) + " does not match the maps of " +
                      material.name() + " (" + size_text(material.width(), material.height()) +
                      ") (make the image " + size_text(material.width(), material.height()) + ")");
  const std::vector<std::byte> texels = texels_of(reader);
  for (std::size_t c = 0; c < layout.channels.size(); ++c)
    use(channel_values(layout, c, texels), static_cast<int>(c) == layout.alpha_channel);
}

void require_background(const std::filesystem::path& image, std::size_t marked, const MaterialRef& material) {
  if (4 * marked > 3 * material.width() * material.height())
    throw input_error(
        image.string() +
        ": strokes cover more than three quarters of the image (check that the image is not inverted)");
}

std::vector<std::uint32_t> read_stroke(const std::filesystem::path& mask, const MaterialRef& material) {
  std::vector<char> marked(material.width() * material.height(), 0);
  read_stroke_image(mask, material, [&](const std::vector<float>& values, bool is_alpha) {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!is_alpha && values[i] > 0.5f) marked[i] = 1;
  });
  std::vector<std::uint32_t> stroke;
  for (std::uint32_t i = 0; i < marked.size(); ++i)
    if (marked[i] != 0) stroke.push_back(i);
  if (stroke.empty())
    throw input_error(mask.string() + ": the mask marks no texel (paint strokes brighter than 0.5)");
  require_background(mask, stroke.size(), material);
  return stroke;
}

std::vector<std::uint32_t> box_stroke(const std::string& box, const MaterialRef& material) {
  const auto fail = [&] {
    throw usage_error("--box: '" + box + "' is not a box within " +
                      size_text(material.width(), material.height()) +
                      " texels (use x0,y0,x1,y1 with x0 < x1 and y0 < y1)");
  };
  std::vector<std::size_t> corner;
  std::istringstream parts(box);
  for (std::string part; std::getline(parts, part, ',');) {
    const auto number = parse_number(part);
    if (!number || !(*number >= 0.0 && *number <= 1e6)) fail();  // this also rejects "nan", which is a number
    corner.push_back(static_cast<std::size_t>(*number));
  }
  if (corner.size() != 4 || corner[0] >= corner[2] || corner[1] >= corner[3] ||
      corner[2] > material.width() || corner[3] > material.height())
    fail();
  std::vector<std::uint32_t> stroke;
  for (std::size_t y = corner[1]; y < corner[3]; ++y)
    for (std::size_t x = corner[0]; x < corner[2]; ++x)
      stroke.push_back(static_cast<std::uint32_t>(y * material.width() + x));
  return stroke;
}

}  // namespace remap
