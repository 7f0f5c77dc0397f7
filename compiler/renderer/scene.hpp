// The sweep scene (Sztrajman et al. 2019, section 4.1): a unit sphere at the origin, a pinhole camera on +z
// whose square image just encloses the sphere, and one point light of unit intensity.
#pragma once

#include <string>
#include <vector>

namespace remapc {

inline constexpr double kCameraDistance = 3.0;

// A point light of unit intensity, `angle` degrees from the camera about the vertical axis as seen from the
// sphere (0: headlight), `distance` from the origin in sphere radii (> 1).
struct Light {
  double angle = 0.0;
  double distance = 3.0;
  bool operator==(const Light&) const = default;
};

// What the camera sees (shape.hpp). Sweeps are of the sphere.
enum class Shape { kSphere, kTorus };

// One picture to take. `samples_per_axis` = 1 samples pixel centres; N averages an N x N grid in each pixel.
struct Scene {
  int resolution = 512;  // width and height in pixels
  int samples_per_axis = 1;
  Light light;
  int seed = 0;  // of renderers with noise
  Shape shape = Shape::kSphere;
  bool operator==(const Scene&) const = default;
};

// `headlight` for the light at the camera, else the angle in degrees with the distance where it is not 3.
std::string light_name(const Light& light);

// A point of the sphere that the camera sees; view space is world space (camera on +z).
struct SurfacePoint {
  double x, y, z;  // position on the unit sphere, which is also the normal
};

// Direction, not normalised, of the ray from the camera through the image at (column, row), in pixels from
// the top left corner.
SurfacePoint camera_ray(int resolution, double column, double row);

// Where the ray through the image at (column + u, row + v), in pixels from the top left corner, meets the
// sphere. False where it misses.
bool sphere_point(int resolution, double column, double row, SurfacePoint* point);

// Cosine between normal and view direction for each pixel of a picture, averaged over its samples; 0 where
// the pixel does not show the sphere. Row-major, resolution^2 values.
std::vector<float> view_cosines(int resolution, int samples_per_axis);

}  // namespace remapc
