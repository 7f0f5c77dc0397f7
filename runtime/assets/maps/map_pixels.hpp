// This file turns pixels into maps of the conversion in memory (remap/convert_maps.hpp), and measures them.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>

#include "assets/document/asset.hpp"
#include "remap/convert_maps.hpp"
#include "remap/pixels.hpp"

namespace remap {

// Returns a read-only view if `pixels` is const; otherwise a writable one.
template <typename Pixels>
auto channel_of_pixels(Pixels& pixels, std::size_t channel) {
  const auto texel = static_cast<std::ptrdiff_t>(pixels.texel_bytes());
  using Byte = std::remove_pointer_t<decltype(pixels.bytes.data())>;
  return BasicChannelView<Byte>{pixels.bytes.data() + channel * byte_count(pixels.type), pixels.type, texel,
                                texel * static_cast<std::ptrdiff_t>(pixels.width)};
}

// Returns an image with the size and type of the model. Every value is the largest.
ImagePixels blank_like(const ImagePixels& model, std::size_t channels);

// Returns true if every texel equals the first.
bool is_constant(const ImagePixels& pixels);

// Returns true if the values of a channel differ by at most a step of 8 bits.
bool hardly_varies(const ImagePixels& pixels, std::size_t channel);

// Returns the first texel as stored, 0 to 1: red, green, blue and alpha. Grey is repeated, and a missing
// alpha is 1.
std::array<float, 4> first_texel(const ImagePixels& pixels);

// Converts a stored sRGB value to a linear one.
float linear_of_srgb(float value);

// Returns a color in sRGB times linear factors, or the factors if `pixels` is null. `name` is for messages.
SourceParameter color_source(const ImagePixels* pixels, const std::array<double, 3>& factors,
                             const char* name);
// Returns a channel times a factor, or the factor if `pixels` is null. `channel` is an index into RGBA. A
// grey image has one channel for all three colors.
SourceParameter value_source(const ImagePixels* pixels, std::size_t channel, double factor, const char* name);

// Returns the first three channels of `pixels` as the place for a converted color, which is stored as sRGB.
TargetParameter color_target(ImagePixels& pixels);
// Returns one channel of `pixels` as the place for a converted linear value.
TargetParameter value_target(ImagePixels& pixels, std::size_t channel);

// Returns true if the colors of `result` equal `map` times the factors, within a step of 8 bits.
bool is_map_times(const ImagePixels& result, const ImagePixels& map, const std::array<double, 3>& factors);

// A NormalShares holds measures that distinguish normals from other colors. Vectors are decoded from 0 to 1.
struct NormalShares {
  double unit = 0.0, inwards = 0.0;  // fractions of texels: of about unit length; pointing into the surface
  std::array<double, 3> mean{};      // mean of red, green and blue as stored

  // Returns true if a map of heights or normals holds normals of tangent space. Heights are grey.
  bool are_normals() const;
};
// Measures three channels of the same size.
NormalShares normal_shares(const std::array<std::span<const float>, 3>& rgb);

// Returns the result of are_normals() for texels of an even grid.
bool holds_normals(const ImagePixels& pixels);

// Copies the alpha channel. Both images must have one.
void copy_alpha(const ImagePixels& from, ImagePixels& to);

// Fills a channel with its largest value.
void fill_channel(ImagePixels& pixels, std::size_t channel);

// Returns the RMS of Parameter::kResidual over an even grid of texels. All texels would take longer than the
// conversion itself.
double sampled_residual(const Converter& converter, MapConversion conversion);

}  // namespace remap
