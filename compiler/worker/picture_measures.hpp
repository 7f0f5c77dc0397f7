// Measures of pictures that tell what is wrong with a renderer: where its light falls, how it differs from
// another picture, in which steps its values come.
#pragma once

#include <string>
#include <vector>

#include "renderer/image.hpp"
#include "renderer/scene.hpp"

namespace remapc {

// Largest value of the first channel, of pixels that do not show the sphere if `beside` is set.
double brightest(const Image& image, bool beside = false);

// Mean place of the light in x and y, from -1 (left, bottom) to 1; 0, 0 of a black picture.
struct Centroid {
  double x = 0.0, y = 0.0;
};
Centroid centroid(const Image& image);

// RMS of the difference relative to the RMS of `a`, over pixels that lie well within the sphere; 0 for two
// black pictures. First channel.
double difference(const Image& a, const Image& b);

// Turned about the middle: rows or columns in the other order.
Image flipped(const Image& image, bool rows);

// The first channel, or another, as a picture of its own.
Image channel(const Image& image, int index);

// Every third pixel of every third row, from the second: what the pixel centres of a picture a third as large
// see. And the mean of each three by three.
Image every_third(const Image& image);
Image mean_of_nine(const Image& image);

// Radiance of a Lambertian sphere of albedo 1 in `scene`, at pixel centres.
Image lambertian(const Scene& scene);

// The factor between two pictures in least squares, `of` = factor * `unit`.
double factor(const Image& of, const Image& unit);

// How the values are stored: `8 bits`, `half floats`, or empty where nothing shows that they are coarser than
// floats.
std::string coarse_values(const Image& image);

// Pixels that share the largest value.
std::size_t count_of_brightest(const Image& image);

}  // namespace remapc
