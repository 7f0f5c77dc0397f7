// The picture of a sphere as a display shows it, and how alike two look.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace remapc {

// Display values (sweep/image_similarity.hpp) of linear ones.
std::vector<float> display_values(std::span<const float> radiance);

struct DisplayedSphere {
  std::vector<float> colors;  // RGB of the pixels that show the sphere
  std::vector<float> luma;    // of the whole picture, row by row; 0 beside the sphere
};

// `radiance`: linear RGB of `pixels`, which are indices, row by row, into a picture of `resolution` x
// `resolution`.
DisplayedSphere displayed_sphere(std::span<const float> radiance, std::span<const std::uint32_t> pixels,
                                 int resolution);

// Mean structural similarity of luma over the pixels of the sphere; 1 for equal pictures.
double sphere_similarity(const DisplayedSphere& a, const DisplayedSphere& b,
                         std::span<const std::uint32_t> pixels, int resolution);

}  // namespace remapc
