#include "worker/picture_measures.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace remapc {
namespace {

// Pixels with a smaller view cosine are too close to the silhouette: their neighbours may not show the
// sphere.
constexpr float kWellWithin = 0.2f;

std::size_t index_of(const Image& image, int row, int column) {
  return (static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
          static_cast<std::size_t>(column)) *
         static_cast<std::size_t>(image.channels);
}

double value(const Image& image, int row, int column) {
  return static_cast<double>(image.values[index_of(image, row, column)]);
}

// Makes a grey picture of the same size, pixel by pixel.
template <typename Pixel>
Image made(int side, const Pixel& pixel) {
  Image image{side, side, 1, {}};
  image.values.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      image.values.push_back(static_cast<float>(pixel(row, column)));
  return image;
}

// Calls `use(value of a, value of b)` for pixels whose neighbours show the sphere too.
template <typename Use>
void for_sphere(const Image& a, const Image& b, const Use& use) {
  const std::vector<float> cosines = view_cosines(a.width, 1);
  for (int row = 0; row < a.height; ++row)
    for (int column = 0; column < a.width; ++column)
      if (cosines[static_cast<std::size_t>(row * a.width + column)] > kWellWithin)
        use(value(a, row, column), value(b, row, column));
}

}  // namespace

double brightest(const Image& image, bool outside) {
  const std::vector<float> cosines = view_cosines(image.width, 1);
  double most = 0.0;
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column)
      if (!outside || cosines[static_cast<std::size_t>(row * image.width + column)] <= 0.0f)
        most = std::max(most, std::fabs(value(image, row, column)));
  return most;
}

Centroid centroid(const Image& image) {
  double sum = 0.0;
  Centroid place;
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column) {
      const double light = value(image, row, column);
      sum += light;
      place.x += light * (2.0 * (column + 0.5) / image.width - 1.0);
      place.y += light * (1.0 - 2.0 * (row + 0.5) / image.height);
    }
  if (!(sum > 0.0)) return {};
  return {place.x / sum, place.y / sum};
}

double difference(const Image& a, const Image& b) {
  double square = 0.0, power = 0.0;
  for_sphere(a, b, [&](double x, double y) {
    square += (x - y) * (x - y);
    power += x * x;
  });
  if (square == 0.0) return 0.0;
  return std::sqrt(square / std::max(power, 1e-30));
}

Image flipped(const Image& image, bool rows) {
  const int last = image.width - 1;
  return made(image.width, [&](int row, int column) {
    return rows ? value(image, last - row, column) : value(image, row, last - column);
  });
}

Image channel(const Image& image, int index) {
  return made(image.width, [&](int row, int column) {
    return image.values[index_of(image, row, column) + static_cast<std::size_t>(index)];
  });
}

Image every_third(const Image& image) {
  return made(image.width / 3,
              [&](int row, int column) { return value(image, 3 * row + 1, 3 * column + 1); });
}

Image mean_of_nine(const Image& image) {
  return made(image.width / 3, [&](int row, int column) {
    double sum = 0.0;
    for (int i = 0; i < 9; ++i) sum += value(image, 3 * row + i / 3, 3 * column + i % 3);
    return sum / 9.0;
  });
}

Image lambertian(const Scene& scene) {
  const double angle = scene.light.angle * std::numbers::pi / 180.0, distance = scene.light.distance;
  return made(scene.resolution, [&](int row, int column) {
    SurfacePoint n;
    if (!sphere_point(scene.resolution, column + 0.5, row + 0.5, &n)) return 0.0;
    const double x = distance * std::sin(angle) - n.x, z = distance * std::cos(angle) - n.z;
    const double length = std::sqrt(x * x + n.y * n.y + z * z);
    const double cosine = (x * n.x - n.y * n.y + z * n.z) / length;
    return std::max(0.0, cosine) * std::numbers::inv_pi / (length * length);
  });
}

double factor(const Image& of, const Image& unit) {
  double product = 0.0, power = 0.0;
  for_sphere(of, unit, [&](double x, double y) {
    product += x * y;
    power += y * y;
  });
  return power > 0.0 ? product / power : 0.0;
}

std::string coarse_values(const Image& image) {
  bool eight_bits = true, halves = true;
  for (const float v : image.values) {
    if (v == 0.0f || v == 1.0f) continue;
    const double steps = 255.0 * static_cast<double>(v);
    eight_bits = eight_bits && std::fabs(steps - std::round(steps)) < 1e-4;
    halves = halves && (std::bit_cast<std::uint32_t>(v) & 0x1fffu) == 0;  // 10 of 23 mantissa bits
  }
  return eight_bits ? "8 bits" : halves ? "half floats" : "";
}

std::size_t count_of_brightest(const Image& image) {
  const auto most = std::max_element(image.values.begin(), image.values.end());
  return static_cast<std::size_t>(std::count(image.values.begin(), image.values.end(), *most));
}

}  // namespace remapc
