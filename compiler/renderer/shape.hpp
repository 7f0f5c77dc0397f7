// What stands in the scene: the sphere of every sweep, or a torus, to look at a conversion on another shape.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "renderer/scene.hpp"

namespace remapc {

inline constexpr std::array kShapes = {Shape::kSphere, Shape::kTorus};

// `sphere`, `torus`.
std::string shape_name(Shape shape);
// Throws kUsage with the nearest known name.
Shape shape_from_name(const std::string& name);

// The torus: centre at the origin, within the unit sphere; its axis leans from the camera towards y so that
// the hole and both flanks show.
inline constexpr double kTorusRadius = 0.68;  // of the circle in the middle of the tube
inline constexpr double kTubeRadius = 0.3;
inline constexpr double kTorusTilt = 40.0;  // degrees from +z to +y

struct SurfaceHit {
  SurfacePoint position;
  SurfacePoint normal;
};

// Where the ray through the image at (column + u, row + v), as sphere_point has it, meets the shape. False
// where it misses.
bool shape_point(Shape shape, int resolution, double column, double row, SurfaceHit* hit);

// Whether the shape itself keeps light at `light` from the point. A sphere does so only where the light is
// below the horizon, which is not asked here.
bool is_shadowed(Shape shape, const SurfaceHit& hit, const SurfacePoint& light);

// Indices, row by row, of the pixels whose centres show the shape.
std::vector<std::uint32_t> shape_pixels(Shape shape, int resolution);

}  // namespace remapc
