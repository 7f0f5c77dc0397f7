// This file has a diffuse lobe that differs from Lambert's: the qualitative model of Oren and Nayar 1994, for
// rough clay. It is flatter towards the rim of a sphere, so no factor turns it into Lambert's lobe.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "look/image.hpp"
#include "look/scene.hpp"

namespace remap {

// Returns the factor that multiplies Lambert's reflectance. `sigma` is the standard deviation of the slopes'
// angles in radians.
inline double oren_nayar_factor(double cos_light, double cos_view, double cos_between, double sigma) {
  const double square = sigma * sigma;
  const double a = 1.0 - 0.5 * square / (square + 0.33), b = 0.45 * square / (square + 0.09);
  const double sin_light = std::sqrt(std::max(0.0, 1.0 - cos_light * cos_light)),
               sin_view = std::sqrt(std::max(0.0, 1.0 - cos_view * cos_view));
  if (sin_light * sin_view < 1e-12) return a;
  const double cos_azimuth = (cos_between - cos_light * cos_view) / (sin_light * sin_view);
  return a + b * std::max(0.0, cos_azimuth) * sin_light * sin_view / std::max(cos_light, cos_view);
}

// Returns the radiance of a white sphere of this reflectance at the centres of pixels, in one channel.
inline Image oren_nayar_picture(const Scene& scene, double sigma) {
  const double angle = scene.light.angle * std::numbers::pi / 180.0;
  const Vector3 light = {scene.light.distance * std::sin(angle), 0.0, scene.light.distance * std::cos(angle)};
  const auto length = [](const Vector3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); };
  const auto dot = [](const Vector3& a, const Vector3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
  Image image{scene.resolution, scene.resolution, 1, {}};
  for (int row = 0; row < scene.resolution; ++row)
    for (int column = 0; column < scene.resolution; ++column) {
      Vector3 p{};
      double radiance = 0.0;
      if (sphere_point(scene.resolution, column + 0.5, row + 0.5, &p)) {
        const Vector3 to_light = {light.x - p.x, light.y - p.y, light.z - p.z},
                      to_view = {-p.x, -p.y, kCameraDistance - p.z};
        const double far = length(to_light), near = length(to_view);
        const double cos_light = dot(p, to_light) / far, cos_view = dot(p, to_view) / near;
        if (cos_light > 0.0)
          radiance = cos_light / (far * far) / std::numbers::pi *
                     oren_nayar_factor(cos_light, cos_view, dot(to_light, to_view) / (far * near), sigma);
      }
      image.values.push_back(static_cast<float>(radiance));
    }
  return image;
}

}  // namespace remap
