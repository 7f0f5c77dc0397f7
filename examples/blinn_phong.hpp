// This file is a minimal renderer of one sphere with Lambert and Blinn-Phong. lambert_worker.cpp uses it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace example {

using Vector = std::array<double, 3>;

inline const double kPi = std::acos(-1.0);

inline double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector sum(const Vector& a, const Vector& b, double factor) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}
inline Vector unit(const Vector& v) { return sum({}, v, 1.0 / std::sqrt(dot(v, v))); }

struct Material {
  double exponent, specular, diffuse;
};

struct View {
  int side, grid;               // pixels of the picture; samples along each side of a pixel
  double half_angle, distance;  // of the camera on +z, in degrees and sphere radii
  Vector lamp;
};

// Returns the radiance along the ray through (x, y) of the image plane at distance 1 from the camera.
inline double radiance(double x, double y, const View& view, const Material& material) {
  const Vector ray = unit({x, y, -1.0});
  const double middle = -ray[2] * view.distance,
               beneath = middle * middle - view.distance * view.distance + 1.0;
  if (beneath <= 0.0) return 0.0;  // the ray misses the unit sphere
  const Vector point = sum({0.0, 0.0, view.distance}, ray, middle - std::sqrt(beneath));
  const Vector to_lamp = sum(view.lamp, point, -1.0), light = unit(to_lamp);
  const double cosine = dot(light, point);
  if (cosine <= 0.0) return 0.0;
  const double half = std::max(0.0, dot(unit(sum(light, ray, -1.0)), point));
  const double lobe = (material.exponent + 2.0) / (2.0 * kPi) * std::pow(half, material.exponent);
  return (material.diffuse / kPi + material.specular * lobe) * cosine / dot(to_lamp, to_lamp);
}

// Renders a picture, row 0 at the top; channels are interleaved and have a material each.
inline std::vector<float> picture(const View& view, const std::vector<Material>& channels) {
  const double extent = std::tan(view.half_angle * kPi / 180.0);
  const auto at = [&](int sample) { return (2.0 * (sample + 0.5) / (view.side * view.grid) - 1.0) * extent; };
  std::vector<float> pixels;
  for (int row = 0; row < view.side; ++row)
    for (int column = 0; column < view.side; ++column)
      for (const Material& material : channels) {
        double total = 0.0;
        for (int i = 0; i < view.grid * view.grid; ++i)
          total += radiance(at(column * view.grid + i % view.grid), -at(row * view.grid + i / view.grid),
                            view, material);
        pixels.push_back(static_cast<float>(total / (view.grid * view.grid)));
      }
  return pixels;
}

}  // namespace example
