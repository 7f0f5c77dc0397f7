// This file reads the geometry of a Wavefront OBJ file by tinyobjloader: triangles of one material at a time,
// with vertices that are not repeated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "assets/document/asset.hpp"

namespace remap {

// Limits the file, because it takes up to three times as much memory.
inline constexpr std::size_t kLongestObj = std::size_t{1} << 30;
// Polygons with more corners become fans of triangles. Other methods need time proportional to the cube of
// the corners.
inline constexpr std::size_t kMostClippedCorners = 1024;

// An ObjPrimitive is triangles of one material. Attributes have an entry for each vertex, or none at all.
struct ObjPrimitive {
  std::size_t material = 0;            // index into ObjScene::materials
  std::vector<float> positions;        // x, y, z
  std::vector<float> normals;          // of length 1; missing normals are computed from the faces
  std::vector<float> texcoords;        // u, v, with v from the top as in glTF
  std::vector<float> colors;           // red, green, blue from 0 to 1
  std::vector<std::uint32_t> indices;  // three for a triangle

  std::size_t vertex_count() const noexcept { return positions.size() / 3; }
};

// An ObjShape is a group or an object.
struct ObjShape {
  std::string name;  // may be empty
  std::vector<ObjPrimitive> primitives;
};

// An ObjMaterialName is the name of a material. Faces before the first `usemtl` have no material.
struct ObjMaterialName {
  std::string name;
  bool is_given = false;
};

struct ObjScene {
  std::vector<std::string> libraries;      // the arguments of each line `mtllib`
  std::vector<ObjMaterialName> materials;  // materials that faces use, in the order of the file
  std::vector<ObjShape> shapes;            // shapes with at least one triangle
  std::vector<std::string> warnings;
};

// Returns only ObjScene::libraries, which takes less time.
std::vector<std::string> obj_libraries(const ByteSource& source, const std::string& context);

// Reads a file. Throws kInput, beginning with `context`, beyond the limit, and for UTF-16 with half a
// character. Also throws it for coordinates that are not numbers and for faces with missing vertices.
ObjScene read_obj(const ByteSource& source, const std::string& context);

}  // namespace remap
