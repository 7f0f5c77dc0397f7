#include "assets/maps/texture_bake.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "assets/document/gltf_extensions.hpp"
#include "core/errors.hpp"
#include "remap/pixels.hpp"

namespace remap {
namespace {

using TextureCoordinates = std::array<double, 2>;  // u and v

// Applies scale, then rotation, then offset. A positive angle turns counter-clockwise on screen, with v
// downwards. three.js (Matrix3.setUvTransform) and Khronos' sample viewer do the same.
TextureCoordinates transformed(const TextureTransform& transform, const TextureCoordinates& at) {
  const double u = at[0] * transform.scale[0], v = at[1] * transform.scale[1];
  const double cosine = std::cos(transform.rotation), sine = std::sin(transform.rotation);
  return {cosine * u + sine * v + transform.offset[0], cosine * v - sine * u + transform.offset[1]};
}

TextureCoordinates untransformed(const TextureTransform& transform, const TextureCoordinates& at) {
  const double u = at[0] - transform.offset[0], v = at[1] - transform.offset[1];
  const double cosine = std::cos(transform.rotation), sine = std::sin(transform.rotation);
  return {(cosine * u - sine * v) / transform.scale[0], (sine * u + cosine * v) / transform.scale[1]};
}

// A RepeatedPlace lies between two neighboring texels of a row or column. The row or column repeats, so the
// first texel follows the last.
struct RepeatedPlace {
  std::size_t before = 0, after = 0;
  float share = 0.0f;  // weight of `after`, 0 to 1
};

RepeatedPlace place_at(double coordinate, std::size_t count) {
  const double size = static_cast<double>(count);
  const double position = (coordinate - std::floor(coordinate)) * size - 0.5;
  const double floor = std::floor(position);
  const auto before = static_cast<std::size_t>(floor < 0.0 ? floor + size : floor) % count;
  return {before, (before + 1) % count, static_cast<float>(position - floor)};
}

// Changes all channels except alpha.
template <typename Change>
void change_colors(const ImagePixels& pixels, std::vector<float>& values, const Change& change) {
  const std::size_t colors = pixels.channels - (pixels.has_alpha() ? 1 : 0);
  for (std::size_t i = 0; i < values.size(); i += pixels.channels)
    change(std::span<float>(values.data() + i, colors));
}

// Writes the values of the map at texture coordinates, from its linear values.
void sample(const ImagePixels& map, const std::vector<float>& values, const TextureCoordinates& at,
            float* out) {
  if (!std::isfinite(at[0]) || !std::isfinite(at[1]))
    throw input_error(std::string(kTransformExtension) +
                      ": the numbers are too large for --resample (use smaller numbers)");
  const RepeatedPlace column = place_at(at[0], map.width), row = place_at(at[1], map.height);
  const auto mixed = [&](std::size_t y, std::size_t channel) {
    const float* const first = values.data() + y * map.width * map.channels + channel;
    return first[column.before * map.channels] * (1.0f - column.share) +
           first[column.after * map.channels] * column.share;
  };
  for (std::size_t c = 0; c < map.channels; ++c)
    out[c] = mixed(row.before, c) * (1.0f - row.share) + mixed(row.after, c) * row.share;
}

// A column states how the coordinates of `to` move if the coordinates of `from` move by 1 in u or v.
using Matrix = std::array<std::array<double, 2>, 2>;
Matrix steps_between(const TextureTransform& from, const TextureTransform& to) {
  Matrix steps{};
  const TextureCoordinates origin = transformed(to, untransformed(from, {0.0, 0.0}));
  for (std::size_t i = 0; i < 2; ++i) {
    const TextureCoordinates moved =
        transformed(to, untransformed(from, {i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0}));
    steps[0][i] = moved[0] - origin[0];
    steps[1][i] = moved[1] - origin[1];
  }
  return steps;
}

bool is_whole(const Matrix& steps) {
  constexpr double kRounding = 1e-4;
  for (const auto& row : steps)
    for (const double step : row)
      if (!(std::fabs(step - std::round(step)) < kRounding)) return false;
  return true;
}

// Returns true if texture coordinates from 0 to 1 stay within 0 to 1.
bool is_within_one(const TextureTransform& transform) {
  constexpr double kRounding = 1e-6;
  for (const double u : {0.0, 1.0})
    for (const double v : {0.0, 1.0}) {
      const TextureCoordinates at = transformed(transform, {u, v});
      for (const double coordinate : {at[0], at[1]})
        if (!(coordinate > -kRounding && coordinate < 1.0 + kRounding)) return false;
    }
  return true;
}

// Returns the size at which no texture loses detail.
TextureGrid grid_of(const std::vector<TextureGrid>& textures, const TextureTransform& place) {
  constexpr double kMostTexels = 4096.0;
  double width = 0.0, height = 0.0, most = kMostTexels;
  for (const TextureGrid& texture : textures) {
    const Matrix steps = steps_between(place, texture.transform);
    const auto own_width = static_cast<double>(texture.width),
               own_height = static_cast<double>(texture.height);
    most = std::max({most, own_width, own_height});
    width = std::max({width, own_width * std::fabs(steps[0][0]), own_height * std::fabs(steps[1][0])});
    height = std::max({height, own_width * std::fabs(steps[0][1]), own_height * std::fabs(steps[1][1])});
  }
  const auto texels = [most](double count) {
    return static_cast<std::size_t>(std::clamp(std::round(count), 1.0, most));
  };
  return {texels(width), texels(height), place};
}

}  // namespace

std::optional<CommonGrid> common_grid(const std::vector<TextureGrid>& textures) {
  const auto area = [&](std::size_t i) {
    const TextureTransform& transform = textures[i].transform;
    return std::fabs(transform.scale[0] * transform.scale[1]);
  };
  std::vector<std::size_t> order(textures.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, area);
  const auto repeats_in = [&](std::size_t i) {
    return std::ranges::all_of(textures, [&](const TextureGrid& other) {
      return is_whole(steps_between(textures[i].transform, other.transform));
    });
  };
  if (const auto found = std::ranges::find_if(order, repeats_in); found != order.end())
    return CommonGrid{*found, grid_of(textures, textures[*found].transform), true};
  const auto covers = [&](std::size_t i) { return area(i) > 0.0 && is_within_one(textures[i].transform); };
  if (const auto found = std::ranges::find_if(order, covers); found != order.end())
    return CommonGrid{*found, grid_of(textures, textures[*found].transform), false};
  return std::nullopt;
}

ImagePixels baked(const ImagePixels& map, Transfer transfer, const TextureTransform& transform,
                  const TextureGrid& grid) {
  for (const double scale : grid.transform.scale)
    if (scale == 0.0 || !std::isfinite(1.0 / scale))
      throw input_error(
          std::string(kTransformExtension) +
          ".scale: is 0, so --resample cannot use this transform (set both numbers to another value)");
  std::vector<float> from(map.width * map.height * map.channels);
  load_values(map.type, map.bytes.data(), byte_count(map.type), from.size(), from.data());
  change_colors(map, from, [&](std::span<float> colors) { to_linear(transfer, colors); });
  std::vector<float> values(grid.width * grid.height * map.channels);
  for (std::size_t y = 0; y < grid.height; ++y)
    for (std::size_t x = 0; x < grid.width; ++x) {
      const TextureCoordinates own = {(static_cast<double>(x) + 0.5) / static_cast<double>(grid.width),
                                      (static_cast<double>(y) + 0.5) / static_cast<double>(grid.height)};
      sample(map, from, transformed(transform, untransformed(grid.transform, own)),
             values.data() + (y * grid.width + x) * map.channels);
    }
  change_colors(map, values, [&](std::span<float> colors) { from_linear(transfer, colors); });
  ImagePixels result{grid.width, grid.height, map.channels, map.type, {}};
  result.bytes.resize(values.size() * byte_count(map.type));
  (void)store_values(map.type, values.data(), values.size(), result.bytes.data(), byte_count(map.type));
  return result;
}

}  // namespace remap
