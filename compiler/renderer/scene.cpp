#include "renderer/scene.hpp"

#include <cmath>
#include <numbers>

#include "text/number_text.hpp"

namespace remapc {

std::string light_name(const Light& light) {
  std::string name = light.angle == 0.0 ? "headlight" : remap::number_text(light.angle);
  if (light.distance != Light{}.distance) name += "@" + remap::number_text(light.distance);
  return name;
}

SurfacePoint camera_ray(int resolution, double column, double row) {
  // The edge of the picture touches the sphere: tan(asin(1 / distance)).
  const double half_extent = 1.0 / std::sqrt(kCameraDistance * kCameraDistance - 1.0);
  return {(2.0 * column / resolution - 1.0) * half_extent, (1.0 - 2.0 * row / resolution) * half_extent,
          -1.0};
}

bool sphere_point(int resolution, double column, double row, SurfacePoint* point) {
  const SurfacePoint ray = camera_ray(resolution, column, row);
  const double dx = ray.x, dy = ray.y;
  // Ray (0, 0, d) + t (dx, dy, -1) against x^2 + y^2 + z^2 = 1; the smaller root is the visible point.
  const double a = dx * dx + dy * dy + 1.0;
  const double b = kCameraDistance;
  const double discriminant = b * b - a * (b * b - 1.0);
  if (discriminant <= 0.0) return false;
  const double t = (b - std::sqrt(discriminant)) / a;
  *point = {t * dx, t * dy, kCameraDistance - t};
  return true;
}

std::vector<float> view_cosines(int resolution, int samples_per_axis) {
  std::vector<float> cosines;
  cosines.reserve(static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution));
  const double step = 1.0 / samples_per_axis;
  for (int row = 0; row < resolution; ++row) {
    for (int column = 0; column < resolution; ++column) {
      double sum = 0.0;
      for (int v = 0; v < samples_per_axis; ++v) {
        for (int u = 0; u < samples_per_axis; ++u) {
          SurfacePoint p;
          if (!sphere_point(resolution, column + (u + 0.5) * step, row + (v + 0.5) * step, &p)) continue;
          const double to_camera = kCameraDistance - p.z;
          const double distance = std::sqrt(p.x * p.x + p.y * p.y + to_camera * to_camera);
          sum += (p.z * to_camera - p.x * p.x - p.y * p.y) / distance;
        }
      }
      cosines.push_back(static_cast<float>(sum * step * step));
    }
  }
  return cosines;
}

}  // namespace remapc
