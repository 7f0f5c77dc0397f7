// This file reads or computes environment maps in latitude and longitude, and prepares them for
// the mean radiance over a cone of directions, by a pyramid of grids, each half as large as the previous.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "look/image.hpp"
#include "look/scene.hpp"

namespace remap {

// An Environment is linear RGB radiance. The map is twice as wide as high. Its top row is +y. Its middle
// column is -z, the viewing direction of the camera. Columns to the right turn towards +x.
struct Environment {
  std::string name;
  Image map;
};

// A MapPosition is the place of a direction in a map. It is 0 to 1 in width and height, from the top left
// corner. The following functions convert directions to places and places to directions.
struct MapPosition {
  double u = 0.0, v = 0.0;
};
MapPosition map_position(const Vector3& direction);
Vector3 map_direction(const MapPosition& position);

// Reads an HDR or EXR file. The environment gets the name of the file. A single channel is grey, and values
// below 0 become 0. Throws kInput for a file that cannot be read or is not twice as wide as high. Also throws
// it for a black file and for values that are not finite.
Environment load_environment(const std::filesystem::path& path);

// Computes three environments with `height` rows. `sky` is a clear sky with sun, `overcast` an overcast sky,
// and `studio` a dim room with three area lights.
std::vector<Environment> builtin_environments(int height = 256);

// Multiplies the radiance by `exposure`.
Environment exposed(Environment environment, double exposure);

// Throws kUsage if two environments have the same name.
void require_names_differ(const std::vector<Environment>& environments);

// Returns for example `sky, studio`.
std::string environment_names(const std::vector<Environment>& environments);

// Returns the mean luminance over all directions.
double mean_luminance(const Environment& environment);

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
