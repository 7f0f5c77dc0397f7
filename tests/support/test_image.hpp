// This file writes and reads images for tests only by OpenImageIO, so that they can judge the image I/O of
// the project.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>

#include "support/noise.hpp"

namespace remap {

struct TestImage {
  OIIO::ImageSpec spec;
  std::vector<float> values;         // interleaved; integers are divided by their largest value
  std::vector<unsigned char> bytes;  // bytes as stored

  float at(int x, int y, int channel) const {
    return values[static_cast<std::size_t>((y * spec.width + x) * spec.nchannels + channel)];
  }
  int channel(const std::string& name) const { return spec.channelindex(name); }
};

using TexelFunction = std::function<float(int x, int y, int channel)>;

// Returns a description with channels of these names (R, G, B, A, Y, ... get their usual roles).
OIIO::ImageSpec test_spec(int width, int height, const std::vector<std::string>& channels,
                          OIIO::TypeDesc type);

// Writes an image. Throws std::runtime_error if OpenImageIO fails.
void write_image(const std::filesystem::path& path, const OIIO::ImageSpec& spec, const TexelFunction& texel);
TestImage read_image(const std::filesystem::path& path);

// Returns true if images of one size hold the same values in a channel.
bool same_channel(const TestImage& a, const TestImage& b, int channel);

}  // namespace remap
