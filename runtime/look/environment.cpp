#include "look/environment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "look/image.hpp"
#include "remap/error.hpp"

namespace remap {
namespace {

using std::numbers::pi;

double product(const Vector3& a, const Vector3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

double angle_between(const Vector3& a, const Vector3& b) {
  return std::acos(std::clamp(product(a, b), -1.0, 1.0));
}

// Returns the direction at `elevation` above the horizon and at `azimuth`, which turns from -z towards +x,
// both in degrees.
Vector3 direction_at(double elevation, double azimuth) {
  return map_direction({0.5 + azimuth / 360.0, 0.5 - elevation / 180.0});
}

Environment computed(const std::string& name, int height,
                     const std::function<Rgb(const Vector3&)>& radiance) {
  Environment environment{name, {2 * height, height, 3, {}}};
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < 2 * height; ++column) {
      const Rgb color = radiance(map_direction({(column + 0.5) / (2.0 * height), (row + 0.5) / height}));
      for (const double value : color) environment.map.values.push_back(static_cast<float>(value));
    }
  return environment;
}

// A CieSky is the relative luminance of a CIE sky (ISO 15469:2004) by zenith angle and sun angle.
struct CieSky {
  double a, b, c, d, e;
  double luminance(double cos_zenith, double from_sun) const {
    const double gradation = 1.0 + a * std::exp(b / std::max(cos_zenith, 0.01));
    const double cos_sun = std::cos(from_sun);
    return gradation * (1.0 + c * (std::exp(d * from_sun) - std::exp(d * pi / 2.0)) + e * cos_sun * cos_sun);
  }
};
constexpr CieSky kOvercast{4.0, -0.7, 0.0, -1.0, 0.0};   // CIE sky type 1
constexpr CieSky kClear{-1.0, -0.32, 10.0, -3.0, 0.45};  // CIE sky type 12

// Returns a smooth step from 1 to 0 over `softness` around `edge`.
double soft_step(double value, double edge, double softness) {
  const double t = std::clamp(0.5 + (edge - value) / softness, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// Returns a clear sky with the sun at 40 degrees, to the right behind the camera. The sun's disc has 1.5
// degrees, so that a map of 256 rows resolves it. The sun gives a horizontal surface five times the
// irradiance of the sky, as on a clear day. The ground is grey.
Environment clear_sky(int height) {
  const Vector3 sun = direction_at(40.0, 120.0);
  const double radius = 1.5 * pi / 180.0;
  const double scale = 0.5 / kClear.luminance(1.0, pi / 2.0 - 40.0 * pi / 180.0);
  const double sun_radiance = 5.0 * 0.5 * pi / (pi * radius * radius * sun.y);
  return computed("sky", height, [=](const Vector3& w) -> Rgb {
    if (w.y <= 0.0) return {0.42, 0.38, 0.33};
    const double from_sun = angle_between(w, sun);
    const double sky = scale * kClear.luminance(w.y, from_sun);
    const double disc = sun_radiance * soft_step(from_sun, radius, 0.5 * radius);
    return {0.75 * sky + disc, 0.95 * sky + 0.95 * disc, 1.4 * sky + 0.85 * disc};
  });
}

Environment overcast_sky(int height) {
  const double scale = 0.8 / kOvercast.luminance(1.0, 0.0);
  return computed("overcast", height, [=](const Vector3& w) -> Rgb {
    if (w.y <= 0.0) return {0.10, 0.11, 0.08};
    const double sky = scale * kOvercast.luminance(w.y, 0.0);
    return {0.97 * sky, sky, 1.05 * sky};
  });
}

// An AreaLight is a rectangle that faces the sphere: center and half extent in degrees, and radiance.
struct AreaLight {
  double elevation, azimuth, half_height, half_width;
  Rgb radiance;
};

Environment studio(int height) {
  static constexpr std::array<AreaLight, 3> kLights = {{{35.0, -130.0, 18.0, 14.0, {9.0, 8.6, 8.0}},
                                                        {10.0, 100.0, 35.0, 10.0, {3.0, 3.3, 3.8}},
                                                        {55.0, 20.0, 8.0, 30.0, {4.0, 4.0, 4.0}}}};
  return computed("studio", height, [](const Vector3& w) {
    Rgb sum = {0.06 + 0.04 * w.y, 0.06 + 0.04 * w.y, 0.065 + 0.04 * w.y};
    for (const AreaLight& light : kLights) {
      const MapPosition position = map_position(w);
      const double elevation = 180.0 * (0.5 - position.v);
      const double turned = std::remainder(360.0 * (position.u - 0.5) - light.azimuth, 360.0);
      const double share = soft_step(std::fabs(elevation - light.elevation), light.half_height, 2.0) *
                           soft_step(std::fabs(turned), light.half_width, 2.0);
      for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += share * light.radiance[c];
    }
    return sum;
  });
}

}  // namespace

MapPosition map_position(const Vector3& w) {
  return {0.5 + std::atan2(w.x, -w.z) / (2.0 * pi), std::acos(std::clamp(w.y, -1.0, 1.0)) / pi};
}

Vector3 map_direction(const MapPosition& position) {
  const double azimuth = 2.0 * pi * (position.u - 0.5), polar = pi * position.v;
  return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

Environment load_environment(const std::filesystem::path& path) {
  Environment environment{path.stem().string(), read_rgb(path)};
  Image& map = environment.map;
  if (map.width != 2 * map.height)
    throw Error(ErrorKind::kInput,
                path.string() + ": size " + std::to_string(map.width) + "x" + std::to_string(map.height) +
                    " does not fit a map in latitude and longitude (twice as wide as high)");
  for (float& value : map.values) {
    if (!std::isfinite(value))
      throw Error(ErrorKind::kInput, path.string() + ": contains a value that is not finite");
    value = std::max(value, 0.0f);
  }
  if (mean_luminance(environment) <= 0.0)
    throw Error(ErrorKind::kInput, path.string() + ": the map is black");
  return environment;
}

std::vector<Environment> builtin_environments(int height) {
  return {clear_sky(height), overcast_sky(height), studio(height)};
}

Environment exposed(Environment environment, double exposure) {
  for (float& value : environment.map.values) value = static_cast<float>(value * exposure);
  return environment;
}

void require_names_differ(const std::vector<Environment>& environments) {
  std::set<std::string> names;
  for (const Environment& environment : environments)
    if (!names.insert(environment.name).second)
      throw Error(ErrorKind::kUsage,
                  "environments: two have the name '" + environment.name + "' (names must differ)");
}

std::string environment_names(const std::vector<Environment>& environments) {
  std::string names;
  for (const Environment& environment : environments) names += (names.empty() ? "" : ", ") + environment.name;
  return names;
}

double mean_luminance(const Environment& environment) {
  const Image& map = environment.map;
  double sum = 0.0, weights = 0.0;
  for (int row = 0; row < map.height; ++row) {
    const double weight = std::sin(pi * (row + 0.5) / map.height);
    const auto start = static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width);
    for (std::size_t column = 0; column < static_cast<std::size_t>(map.width); ++column)
      sum += weight * luminance(&map.values[3 * (start + column)]);
    weights += weight * map.width;
  }
  return sum / weights;
}

}  // namespace remap
