// This file prepares environments, so that mean radiance over a cone of directions can be looked up. It makes
// a pyramid of grids, each half as large as the previous grid.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "look/environment.hpp"

namespace remap {

// A Lamp is a bright spot of an environment that is small enough to be treated as one direction.
struct Lamp {
  Vector3 direction;
  Rgb flux{};  // radiance times solid angle
};

// A RadiancePyramid does filtered importance sampling (Krivanek and Colbert 2008). A sample that represents a
// solid angle reads the average radiance over about that solid angle. The channels of all environments are
// adjacent, because every sample reads all of them.
class RadiancePyramid {
 public:
  // Resamples maps of any size to `height` rows and twice as many columns. Each texel is the mean over its
  // directions. `height` is a power of two, at least 8.
  explicit RadiancePyramid(std::span<const Environment> environments, int height = 256);

  // Returns the number of channels: three for each environment, in the order of the environments.
  std::size_t channel_count() const { return channel_count_; }

  // Returns at most 128 spots of 1.4 degrees (for 256 rows), with their radiance that exceeds four times the
  // mean.
  const std::vector<Lamp>& lamps(std::size_t environment) const { return lamps_[environment]; }

  // Writes the radiance without lamps from `direction` to `radiance`, one float for each channel. It is
  // averaged over about `solid_angle` (steradian, > 0). Interpolation is trilinear, and exact for constant
  // environments.
  void look_up(const Vector3& direction, double solid_angle, float* radiance) const;

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

}  // namespace remap
