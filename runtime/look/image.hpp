// This file holds a linear float image, the result of a renderer and the input of the match, and reads and
// writes pictures as files. Two pictures are compared as displayed, by root mean square error and structural
// similarity.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace remap {

// An Image is linear radiance, `channels` interleaved values per pixel. Row 0 is at the top, column 0 at -x.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> values;
};

// An Rgb is linear RGB with the primaries of sRGB.
using Rgb = std::array<double, 3>;

// Returns the luminance of linear RGB (ITU-R BT.709), or the luma of display values.
inline double luminance(const float* rgb) {
  return 0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
         0.0722 * static_cast<double>(rgb[2]);
}

// Reads R, G and B of a picture as linear floats. Ignores other channels. The format is any that OpenImageIO
// reads (EXR, HDR). If there is one channel, it becomes all three. Throws kInput for a file that cannot be
// read, and for a file with two channels.
Image read_rgb(const std::filesystem::path& path);

// Writes a linear float32 EXR (zip) with `attributes` as metadata. `channels` holds the channel names; if it
// is empty, one channel is Y and three are R, G, B. The file appears complete or not at all. Throws kOutput.
void write_exr(const std::filesystem::path& path, const Image& image,
               const std::map<std::string, std::string>& attributes,
               const std::vector<std::string>& channels = {});

// Writes display values, 0 to 1, as an 8-bit PNG. The file appears complete or not at all. Throws kOutput.
void write_png(const std::filesystem::path& path, const Image& image);

// Returns the bytes of the file that write_png() writes. Throws kOutput if OpenImageIO cannot encode it.
std::string png_bytes(const Image& image);

// Converts a linear value to a display value: clamps it to [0, 1] and applies the sRGB transfer function (IEC
// 61966-2-1). NaN becomes 0.
float display_value(double linear);

// Converts a display value in [0, 1] back to the linear value, 0 to 1.
double linear_of_display(double display);

// Returns the root mean square of a - b over all values of two pictures, and 0 for empty ones.
double rms_difference(std::span<const float> a, std::span<const float> b);

// Returns the structural similarity (Wang et al. 2004) at each pixel of two grey pictures in display values,
// row by row, `width` * `height` values each. A Gaussian of sigma 1.5 pixels, truncated at 5 pixels, weighs
// the local means and variances. Pictures are mirrored at their edges; K1 = 0.01, K2 = 0.03, range 1. The
// result equals scikit-image's structural_similarity(gaussian_weights=True, sigma=1.5,
// use_sample_covariance=False).
std::vector<float> similarity_map(std::span<const float> a, std::span<const float> b, int width, int height);

// Returns the mean of similarity_map() without its 5 outermost rows and columns, as scikit-image does. If
// nothing is left, returns the mean of the whole map.
double structural_similarity(std::span<const float> a, std::span<const float> b, int width, int height);

}  // namespace remap
