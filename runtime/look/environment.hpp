// This file reads or computes environment maps in latitude and longitude.
#pragma once

#include <filesystem>
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

}  // namespace remap
