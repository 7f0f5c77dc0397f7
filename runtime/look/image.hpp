// This file holds a linear float image, the result of a renderer and the input of the match, and reads and
// writes pictures as files.
#pragma once

#include <array>
#include <filesystem>
#include <map>
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

}  // namespace remap
