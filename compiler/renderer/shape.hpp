// The object in the scene: the sphere of every sweep, or a torus to preview a conversion on another shape.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "renderer/scene.hpp"

namespace remapc {

inline constexpr std::array kShapes = {Shape::kSphere, Shape::kTorus};

// Returns `sphere` or `torus`.
std::string shape_name(Shape shape);
// Throws kUsage for an unknown name, with the nearest.
Shape shape_from_name(const std::string& name);

// The torus is centred at the origin, inside the unit sphere. Its axis is tilted from the camera towards +y,
// so that the hole and both flanks are visible.
inline constexpr double kTorusRadius = 0.68;  // of the circle in the middle of the tube
inline constexpr double kTubeRadius = 0.3;
inline constexpr double kTorusTilt = 40.0;  // degrees from +z to +y

struct SurfaceHit {
  SurfacePoint position;
  SurfacePoint normal;
};

// Intersects the ray through the image at (column, row), as sphere_point does, with the shape. Returns false
// if it misses.
bool shape_point(Shape shape, int resolution, double column, double row, SurfaceHit* hit);

// Whether the shape casts its own shadow on the point, for a light at `light`. Always false for the sphere:
// its own shadow is where the light is below the horizon, which this function does not test.
bool is_shadowed(Shape shape, const SurfaceHit& hit, const SurfacePoint& light);

// Returns the indices, row by row, of the pixels whose centres show the shape.
std::vector<std::uint32_t> shape_pixels(Shape shape, int resolution);

}  // namespace remapc
