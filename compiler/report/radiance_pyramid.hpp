// Environments prepared for lookups over cones of directions: all of them on one grid, in levels that halve
// it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "report/color.hpp"
#include "report/environment.hpp"

namespace remapc {

// A bright spot of an environment, small enough to be lit by from one direction.
struct Lamp {
  Direction direction;
  Rgb flux{};  // radiance times solid angle
};

// Filtered importance sampling (Krivanek and Colbert 2008): a sample that stands for a solid angle reads the
// average radiance over about that solid angle. Channels of all environments lie side by side, since every
// sample asks for all of them.
class RadiancePyramid {
 public:
  // Maps of any size become `height` rows and twice as many columns, each texel the mean over its directions.
  // `height`: a power of two from 8.
  explicit RadiancePyramid(std::span<const Environment> environments, int height = 256);

  // Three for each environment, in their order.
  std::size_t channel_count() const { return channel_count_; }

  // At most 128 spots of 1.4 degrees (on 256 rows) with what they have above four times the mean of the map.
  const std::vector<Lamp>& lamps(std::size_t environment) const { return lamps_[environment]; }

  // Radiance without lamps from `direction`, averaged over about `solid_angle` (steradian, > 0), into
  // `radiance`, one float a channel. Trilinear; constant environments are returned as they are.
  void look_up(const Direction& direction, double solid_angle, float* radiance) const;

 private:
  struct Level {
    int width = 0, height = 0;
    std::vector<float> texels;  // row-major, channel_count_ values each
  };
  void add_bilinear(const Level& level, const MapPosition& position, float share, float* radiance) const;

  std::size_t channel_count_;
  std::vector<Level> levels_;  // from fine to coarse
  std::vector<std::vector<Lamp>> lamps_;
};

}  // namespace remapc
