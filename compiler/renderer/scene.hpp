// The sweep scene (Sztrajman et al. 2019, section 4.1): a unit sphere at the origin, a pinhole camera on +z
// whose square image just encloses the sphere, and one point light of unit intensity.
#pragma once

#include <string>
#include <vector>

namespace remapc {

inline constexpr double kCameraDistance = 3.0;

// A point light of unit intensity. `angle` is measured in degrees at the sphere, from the camera about the
// vertical axis (0: headlight). `distance` is measured from the origin in sphere radii (> 1).
struct Light {
  double angle = 0.0;
  double distance = 3.0;
  bool operator==(const Light&) const = default;
};

// What the camera sees (shape.hpp). Sweeps use the sphere.
enum class Shape { kSphere, kTorus };

// One picture. `samples_per_axis` = 1 samples the pixel centre; N averages an N x N grid in each pixel.
struct Scene {
  int resolution = 512;  // width and height in pixels
  int samples_per_axis = 1;
  Light light;
  int seed = 0;  // for renderers with noise
  Shape shape = Shape::kSphere;
  bool operator==(const Scene&) const = default;
};

// Returns `headlight` for a light at the camera, else its angle in degrees, with the distance if it is not 3.
std::string light_name(const Light& light);

// A point or direction in world space, which is view space (camera on +z).
struct SurfacePoint {
  double x, y, z;  // on the unit sphere, the position is also the normal
};

// Returns the direction, not normalised, of the camera's ray through the image at (column, row), in pixels
// from the top left corner.
SurfacePoint camera_ray(int resolution, double column, double row);

// Intersects the ray through the image at (column, row), in pixels from the top left corner, with the sphere.
// Returns false if it misses.
bool sphere_point(int resolution, double column, double row, SurfacePoint* point);

// Returns cos(normal, view) of each pixel, averaged over its samples; 0 where the pixel does not show the
// sphere. Row-major, resolution^2 values.
std::vector<float> view_cosines(int resolution, int samples_per_axis);

}  // namespace remapc
