// This file holds the sweep scene (Sztrajman et al. 2019, section 4.1): a unit sphere at the origin, a
// pinhole camera on +z whose square image just encloses the sphere, and one point light of unit intensity. A
// torus can replace the sphere to preview a conversion on another shape.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "look/image.hpp"
#include "remap/model.hpp"

namespace remap {

inline constexpr double kCameraDistance = 3.0;

// A Vector3 is a point or a direction in world space, which is also view space: x points right, y up, and the
// camera is on +z. On the unit sphere, the position is also the normal.
struct Vector3 {
  double x = 0.0, y = 0.0, z = 0.0;
};

// A Light is a point light of unit intensity. `angle` is measured in degrees at the sphere, from the camera
// about the vertical axis (0: headlight). `distance` is measured from the origin in sphere radii (> 1).
struct Light {
  double angle = 0.0;
  double distance = 3.0;
  bool operator==(const Light&) const = default;
};

// A Shape is the object in front of the camera. Sweeps use the sphere.
enum class Shape { kSphere, kTorus };
inline constexpr NamedValues<Shape, 2> kShapes = {{{Shape::kSphere, "sphere"}, {Shape::kTorus, "torus"}}};

// A Scene is one picture. `samples_per_axis` 1 samples the pixel centre; N averages an N x N grid.
struct Scene {
  int resolution = 512;  // width and height in pixels
  int samples_per_axis = 1;
  Light light;
  int seed = 0;  // only for renderers with noise
  Shape shape = Shape::kSphere;
  // If this is set, it lights the sphere instead of `light`: the map of an Environment (environment.hpp).
  const Image* environment = nullptr;
  int light_samples = 0;  // of the environment, for each pixel
  bool operator==(const Scene&) const = default;
};

// Returns `headlight` for a light at the camera. Otherwise returns degrees, with the distance if it is not 3.
std::string light_name(const Light& light);

// Returns the direction, not normalised, of the camera's ray through the image at (column, row), in pixels
// from the top left corner.
Vector3 camera_ray(int resolution, double column, double row);

// Intersects the ray through the image at (column, row), in pixels from the top left corner, with the sphere.
// Returns false if it misses.
bool sphere_point(int resolution, double column, double row, Vector3* point);

// Returns cos(normal, view) of each pixel, averaged over its samples, and 0 if the pixel does not show the
// sphere. The values are row-major, resolution^2.
std::vector<float> view_cosines(int resolution, int samples_per_axis);

// Returns `sphere` or `torus`.
inline std::string shape_name(Shape shape) { return std::string(name_of(kShapes, shape)); }

// The torus is centred at the origin, inside the unit sphere. Its axis is tilted from the camera towards +y,
// so that the hole and both flanks are visible.
inline constexpr double kTorusRadius = 0.68;  // radius of the circle in the middle of the tube
inline constexpr double kTubeRadius = 0.3;
inline constexpr double kTorusTilt = 40.0;  // degrees from +z to +y

struct SurfaceHit {
  Vector3 position;
  Vector3 normal;
};

// Intersects the ray through the image at (column, row), like sphere_point(), with the shape. Returns false
// if the ray misses.
bool shape_point(Shape shape, int resolution, double column, double row, SurfaceHit* hit);

// Returns true if the shape casts a shadow on its own point, for a light at `light`. This is always false for
// the sphere. A sphere is dark where the light is below the horizon, which this function does not test.
bool is_shadowed(Shape shape, const SurfaceHit& hit, const Vector3& light);

// Returns the indices, row by row, of the pixels whose centres show the shape.
std::vector<std::uint32_t> shape_pixels(Shape shape, int resolution);

}  // namespace remap
