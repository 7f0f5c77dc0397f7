// The picture of a sphere in display values, and the similarity of two such pictures.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace remapc {

// Converts linear values to display values (renderer/image_similarity.hpp).
std::vector<float> display_values(std::span<const float> radiance);

struct DisplayedSphere {
  std::vector<float> colors;  // RGB of the pixels that show the sphere
  std::vector<float> luma;    // of the whole picture, row-major; 0 outside the sphere
};

// `radiance`: linear RGB of `pixels`, which are row-major indices into a picture of `resolution` x
// `resolution`.
DisplayedSphere displayed_sphere(std::span<const float> radiance, std::span<const std::uint32_t> pixels,
                                 int resolution);

// The mean structural similarity of luma over the pixels of the sphere; 1 for equal pictures.
double sphere_similarity(const DisplayedSphere& a, const DisplayedSphere& b,
                         std::span<const std::uint32_t> pixels, int resolution);

}  // namespace remapc
