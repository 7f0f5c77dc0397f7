#include "look/environment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <string>

#include "core/errors.hpp"
#include "core/plain_text.hpp"
#include "look/image.hpp"

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
    throw input_error(path.string() + ": size " + std::to_string(map.width) + "x" +
                      std::to_string(map.height) +
                      " does not fit a map in latitude and longitude (twice as wide as high)");
  for (float& value : map.values) {
    if (!std::isfinite(value)) throw input_error(path.string() + ": contains a value that is not finite");
    value = std::max(value, 0.0f);
  }
  if (mean_luminance(environment) <= 0.0) throw input_error(path.string() + ": the map is black");
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
      throw usage_error("environments: two have the name '" + environment.name + "' (names must differ)");
}

std::string environment_names(const std::vector<Environment>& environments) {
  return joined(environments, ", ", &Environment::name);
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

namespace {

using std::numbers::pi;

constexpr int kCoarsestHeight = 4;  // number of rows

// A Share is the weight of an input row or column in an output row or column. The weights sum to 1.
struct Share {
  std::size_t source;
  double weight;
};
using Shares = std::vector<std::vector<Share>>;

// `measure(a, b)` returns the weight of the interval between two positions from 0 to 1.
template <typename Measure>
Shares overlaps(int from, int to, const Measure& measure) {
  Shares shares(static_cast<std::size_t>(to));
  for (int i = 0; i < to; ++i) {
    const double begin = static_cast<double>(i) / to, end = static_cast<double>(i + 1) / to;
    const int last = std::min(from - 1, static_cast<int>(std::ceil(end * from)));
    for (int j = static_cast<int>(begin * from); j <= last; ++j) {
      const double low = std::max(begin, static_cast<double>(j) / from);
      const double high = std::min(end, static_cast<double>(j + 1) / from);
      if (high <= low) continue;
      shares[static_cast<std::size_t>(i)].push_back(
          {static_cast<std::size_t>(j), measure(low, high) / measure(begin, end)});
    }
  }
  return shares;
}

// Returns weights of rows. The solid angle of a row is proportional to the difference of the cosines at its
// edges.
Shares row_shares(int from, int to) {
  return overlaps(from, to, [](double a, double b) { return std::cos(pi * a) - std::cos(pi * b); });
}
Shares column_shares(int from, int to) {
  return overlaps(from, to, [](double a, double b) { return b - a; });
}

// Averages `from`, with `channels` values per texel, over the texels of the grid of `rows` and `columns`.
std::vector<float> resampled(const float* from, std::size_t width, std::size_t channels, const Shares& rows,
                             const Shares& columns) {
  std::vector<float> texels;
  texels.reserve(rows.size() * columns.size() * channels);
  std::vector<double> sum(channels);
  for (const auto& row : rows)
    for (const auto& column : columns) {
      std::ranges::fill(sum, 0.0);
      for (const Share& r : row)
        for (const Share& c : column) {
          const float* texel = from + (r.source * width + c.source) * channels;
          for (std::size_t k = 0; k < channels; ++k)
            sum[k] += r.weight * c.weight * static_cast<double>(texel[k]);
        }
      for (const double value : sum) texels.push_back(static_cast<float>(value));
    }
  return texels;
}

constexpr double kLampThreshold = 4.0;  // as a multiple of the mean luminance
constexpr std::size_t kMostLamps = 128;
constexpr int kLampTexels = 2;  // width and height of a spot

// A Spot is a small part of a map whose light is above a certain luminance.
struct Spot {
  int row, column;  // place of its first texel
  Lamp lamp;
  double luminance;
};

double share_above(const float* rgb, double threshold) {
  const double value = luminance(rgb);
  return value > threshold ? 1.0 - threshold / value : 0.0;
}

Spot spot_at(const Image& map, int row, int column, double threshold) {
  Spot spot{row, column, {}, 0.0};
  Vector3 middle;
  for (int r = row; r < row + kLampTexels; ++r)
    for (int c = column; c < column + kLampTexels; ++c) {
      const float* texel = &map.values[3 * static_cast<std::size_t>(r * map.width + c)];
      const double solid_angle =
          2.0 * pi / map.width * (std::cos(pi * r / map.height) - std::cos(pi * (r + 1) / map.height));
      const double share = share_above(texel, threshold) * solid_angle;
      const double weight = share * luminance(texel);
      const Vector3 w = map_direction({(c + 0.5) / map.width, (r + 0.5) / map.height});
      middle = {middle.x + weight * w.x, middle.y + weight * w.y, middle.z + weight * w.z};
      for (std::size_t k = 0; k < 3; ++k) spot.lamp.flux[k] += share * static_cast<double>(texel[k]);
      spot.luminance += weight;
    }
  const double length = std::sqrt(middle.x * middle.x + middle.y * middle.y + middle.z * middle.z);
  if (length > 0.0) spot.lamp.direction = {middle.x / length, middle.y / length, middle.z / length};
  return spot;
}

// Removes the brightest spots from a map and returns them.
std::vector<Lamp> take_lamps(Image* map, double mean) {
  const double threshold = kLampThreshold * mean;
  std::vector<Spot> spots;
  for (int row = 0; row < map->height; row += kLampTexels)
    for (int column = 0; column < map->width; column += kLampTexels) {
      const Spot spot = spot_at(*map, row, column, threshold);
      if (spot.luminance > 0.0) spots.push_back(spot);
    }
  std::ranges::stable_sort(spots, std::ranges::greater{}, &Spot::luminance);
  if (spots.size() > kMostLamps) spots.resize(kMostLamps);
  std::vector<Lamp> lamps;
  for (const Spot& spot : spots) {
    lamps.push_back(spot.lamp);
    for (int r = spot.row; r < spot.row + kLampTexels; ++r)
      for (int c = spot.column; c < spot.column + kLampTexels; ++c) {
        float* texel = &map->values[3 * static_cast<std::size_t>(r * map->width + c)];
        const auto kept = static_cast<float>(1.0 - share_above(texel, threshold));
        for (std::size_t k = 0; k < 3; ++k) texel[k] *= kept;
      }
  }
  return lamps;
}

}  // namespace

RadiancePyramid::RadiancePyramid(std::span<const Environment> environments, int height)
    : channel_count_(3 * environments.size()) {
  if (height < 2 * kCoarsestHeight || (height & (height - 1)) != 0)
    throw usage_error("environments: the number of rows must be a power of two of at least " +
                      std::to_string(2 * kCoarsestHeight) + ", not " + std::to_string(height));
  Level finest{2 * height, height, {}};
  finest.texels.resize(static_cast<std::size_t>(2 * height * height) * channel_count_);
  for (std::size_t e = 0; e < environments.size(); ++e) {
    const Image& map = environments[e].map;
    Image grid{2 * height, height, 3, {}};
    grid.values = resampled(map.values.data(), static_cast<std::size_t>(map.width), 3,
                            row_shares(map.height, height), column_shares(map.width, 2 * height));
    lamps_.push_back(take_lamps(&grid, mean_luminance(environments[e])));
    for (std::size_t i = 0; i < grid.values.size(); ++i)
      finest.texels[i / 3 * channel_count_ + 3 * e + i % 3] = grid.values[i];
  }
  levels_.push_back(std::move(finest));
  while (levels_.back().height > kCoarsestHeight) {
    const Level& fine = levels_.back();
    levels_.push_back(
        {fine.width / 2, fine.height / 2,
         resampled(fine.texels.data(), static_cast<std::size_t>(fine.width), channel_count_,
                   row_shares(fine.height, fine.height / 2), column_shares(fine.width, fine.width / 2))});
  }
}

void RadiancePyramid::add_bilinear(const Level& level, const MapPosition& position, float share,
                                   float* radiance) const {
  const double x = position.u * level.width - 0.5, y = position.v * level.height - 0.5;
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  const auto fx = static_cast<float>(x - column), fy = static_cast<float>(y - row);
  const auto texel = [&](int c, int r) {
    const int wrapped = (c + level.width) % level.width, clamped = std::clamp(r, 0, level.height - 1);
    return &level.texels[static_cast<std::size_t>(clamped * level.width + wrapped) * channel_count_];
  };
  const float *a = texel(column, row), *b = texel(column + 1, row);
  const float *c = texel(column, row + 1), *d = texel(column + 1, row + 1);
  const float wa = share * (1.0f - fx) * (1.0f - fy), wb = share * fx * (1.0f - fy);
  const float wc = share * (1.0f - fx) * fy, wd = share * fx * fy;
  for (std::size_t k = 0; k < channel_count_; ++k)
    radiance[k] += (wa * a[k] + wb * b[k]) + (wc * c[k] + wd * d[k]);
}

void RadiancePyramid::look_up(const Vector3& direction, double solid_angle, float* radiance) const {
  const MapPosition position = map_position(direction);
  // This is the size of a texel at the horizon of the finest level. Each level has four times the solid angle
  // of the previous level. Krivanek and Colbert choose a coarser level, to get smooth pictures from few
  // samples. This is not needed here, because maps without lamps vary little, and it would blur pictures and
  // make them too similar.
  const double texel = pi / levels_.front().height;
  const double level = std::clamp(0.5 * std::log2(solid_angle / (texel * texel)), 0.0,
                                  static_cast<double>(levels_.size() - 1));
  const auto fine = static_cast<std::size_t>(level);
  const auto coarse_share = static_cast<float>(level - static_cast<double>(fine));
  std::fill(radiance, radiance + channel_count_, 0.0f);
  add_bilinear(levels_[fine], position, 1.0f - coarse_share, radiance);
  if (coarse_share > 0.0f) add_bilinear(levels_[fine + 1], position, coarse_share, radiance);
}

}  // namespace remap
