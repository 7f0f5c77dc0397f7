// Measures of pictures that reveal faults of a renderer: where its light is, how pictures differ, and how
// finely their values are stored.
#pragma once

#include <string>
#include <vector>

#include "renderer/image.hpp"
#include "renderer/scene.hpp"

namespace remapc {

// Returns the largest value of the first channel; with `outside`, of the pixels that do not show the sphere.
double brightest(const Image& image, bool outside = false);

// The mean position of the light in x and y, from -1 (left, bottom) to 1; 0, 0 for a black picture.
struct Centroid {
  double x = 0.0, y = 0.0;
};
Centroid centroid(const Image& image);

// Returns the RMS difference relative to the RMS of `a`, in the first channel, over pixels whose neighbours
// show the sphere too; 0 for two black pictures.
double difference(const Image& a, const Image& b);

// Returns the picture with its rows, or its columns, in reverse order.
Image flipped(const Image& image, bool rows);

// Returns one channel as a picture.
Image channel(const Image& image, int index);

// every_third returns every third pixel of every third row, from the second: the pixel centres of a picture a
// third as large. mean_of_nine returns the mean of each 3 x 3 pixels.
Image every_third(const Image& image);
Image mean_of_nine(const Image& image);

// Returns the radiance of a Lambertian sphere of albedo 1 in `scene`, at pixel centres.
Image lambertian(const Scene& scene);

// Returns the least-squares factor between two pictures, `of` = factor * `unit`.
double factor(const Image& of, const Image& unit);

// Returns how coarsely the values are stored: `8 bits`, `half floats`, or empty if nothing shows that they
// are coarser than floats.
std::string coarse_values(const Image& image);

// Returns the number of pixels with the largest value.
std::size_t count_of_brightest(const Image& image);

}  // namespace remapc
