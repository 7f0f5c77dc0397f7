// Shapes as mesh files, for renderers that know none but the sphere.
#pragma once

#include <filesystem>

#include "renderer/scene.hpp"

namespace remapc {

// Writes the torus (shape.hpp) as a PLY file: binary, little endian, vertices with normals, triangles seen
// from outside counter-clockwise, so fine that a facet is off by 1e-4 of the sphere's radius at most. Throws
// kOutput, and kUsage for the sphere, which renderers have of their own.
void write_mesh(Shape shape, const std::filesystem::path& path);

}  // namespace remapc
