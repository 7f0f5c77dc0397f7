#include "look/radiance_pyramid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "remap/error.hpp"

namespace remap {
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
      std::fill(sum.begin(), sum.end(), 0.0);
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
    throw Error(ErrorKind::kUsage,
                "environments: the number of rows must be a power of two of at "
                "least " +
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
