// This file writes shapes as mesh files, for renderers.
#pragma once

#include <filesystem>

#include "look/scene.hpp"

namespace remap {

// Writes the torus (scene.hpp) as a PLY file: binary, little endian, vertices with normals, triangles
// counter-clockwise from outside. Facets deviate by at most 1e-4 of the sphere's radius. Throws kOutput.
// Throws kUsage for the sphere, which renderers make themselves.
void write_mesh(Shape shape, const std::filesystem::path& path);

}  // namespace remap
