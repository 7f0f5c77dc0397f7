#include "report/displayed_sphere.hpp"

#include "renderer/image_similarity.hpp"
#include "report/color.hpp"

namespace remapc {

std::vector<float> display_values(std::span<const float> radiance) {
  std::vector<float> values;
  values.reserve(radiance.size());
  for (const float value : radiance) values.push_back(display_value(static_cast<double>(value)));
  return values;
}

DisplayedSphere displayed_sphere(std::span<const float> radiance, std::span<const std::uint32_t> pixels,
                                 int resolution) {
  const auto side = static_cast<std::size_t>(resolution);
  DisplayedSphere sphere{display_values(radiance), std::vector<float>(side * side, 0.0f)};
  for (std::size_t i = 0; i < pixels.size(); ++i)
    sphere.luma[pixels[i]] = static_cast<float>(luminance(&sphere.colors[3 * i]));
  return sphere;
}

double sphere_similarity(const DisplayedSphere& a, const DisplayedSphere& b,
                         std::span<const std::uint32_t> pixels, int resolution) {
  const std::vector<float> map = similarity_map(a.luma, b.luma, resolution, resolution);
  double sum = 0.0;
  for (const std::uint32_t pixel : pixels) sum += static_cast<double>(map[pixel]);
  return sum / static_cast<double>(pixels.size());
}

}  // namespace remapc
