// Environments that light the spheres of a study: radiance from every direction, as maps in latitude and
// longitude, read from files or computed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/image.hpp"

namespace remapc {

// A direction in the space of the sweep scene: y up, the camera on +z. Of length 1.
struct Direction {
  double x = 0.0, y = 0.0, z = 0.0;
};

// Linear RGB radiance. The map is twice as wide as high; its top row is +y, its middle column -z, which is
// what the camera looks at, and columns to the right turn towards +x.
struct Environment {
  std::string name;
  Image map;
};

// The position of a direction in a map, in shares of its width and height from the top left corner, and back.
struct MapPosition {
  double u = 0.0, v = 0.0;
};
MapPosition map_position(const Direction& direction);
Direction map_direction(const MapPosition& position);

// An HDR or EXR file, named after it. One channel is taken as grey; values below 0 count as 0. Throws kInput
// for a file that cannot be read, is not twice as wide as high, is not finite, or is black.
Environment load_environment(const std::filesystem::path& path);

// Three environments of its own, computed: `sky`, a clear sky with a sun; `overcast`; `studio`, a dim room
// with three area lights. `height` rows.
std::vector<Environment> builtin_environments(int height = 256);

// The same light, `exposure` times as bright.
Environment exposed(Environment environment, double exposure);

// Throws kUsage where two have one name.
void require_names_differ(const std::vector<Environment>& environments);

// `sky, studio`.
std::string environment_names(const std::vector<Environment>& environments);

// The mean of luminance over all directions.
double mean_luminance(const Environment& environment);

}  // namespace remapc
