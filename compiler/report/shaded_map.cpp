#include <algorithm>
#include <cmath>
#include <numbers>

#include "look/image.hpp"
#include "report/contact_sheet.hpp"
#include "report/warp_report.hpp"

namespace remap {
namespace {

using Vector = std::array<double, 3>;  // x to the right, y up, z to the camera
using Radiance = std::array<double, 3>;

constexpr double kSteepest = 0.7;      // tangent of the slope at the edges of the cushion
constexpr double kSurroundings = 0.3;  // uniform radiance from all sides
constexpr double kLeastAlpha = 0.02;   // narrower highlights would be smaller than a pixel

// These are colors that color-blind readers can distinguish (Okabe and Ito 2008).
constexpr std::array<DisplayColor, 7> kStrokeColors = {{{0.84f, 0.37f, 0.00f},
                                                        {0.00f, 0.45f, 0.70f},
                                                        {0.00f, 0.62f, 0.45f},
                                                        {0.94f, 0.89f, 0.26f},
                                                        {0.80f, 0.47f, 0.65f},
                                                        {0.34f, 0.71f, 0.91f},
                                                        {0.90f, 0.62f, 0.00f}}};
constexpr float kDimmed = 0.55f;

constexpr int kMostSamples = 3;  // samples along each side of a pixel

std::size_t texel_at(int sample, int sample_count, std::size_t texel_count) {
  const double place = (static_cast<double>(sample) + 0.5) / static_cast<double>(sample_count);
  return std::min(static_cast<std::size_t>(place * static_cast<double>(texel_count)), texel_count - 1);
}

struct DistantLight {
  Vector direction;
  double irradiance;  // in units of pi, so that 1 shows a white diffuse surface as white
};
constexpr std::array<DistantLight, 2> kLights = {{{{-0.45, 0.50, 0.74}, 0.75}, {{0.50, -0.42, 0.757}, 0.2}}};

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector unit_vector(const Vector& v) {
  const double length = std::sqrt(dot(v, v));
  return {v[0] / length, v[1] / length, v[2] / length};
}

LocalGeometry geometry_of(const Vector& normal, const Vector& light) {
  const Vector sum = {light[0], light[1], light[2] + 1.0};  // the camera is at z
  const Vector half = unit_vector(sum);
  LocalGeometry geometry{};
  geometry.cos_light = dot(normal, light);
  geometry.cos_view = normal[2];
  geometry.cos_half = dot(normal, half);
  geometry.cos_light_half = dot(light, half);
  geometry.half_length_2 = dot(sum, sum);
  geometry.cos_mirror = 2.0 * geometry.cos_light * geometry.cos_view - light[2];
  return geometry;
}

Radiance radiance_of(const WarpTexel& texel, const BrdfModel& model, const Vector& normal) {
  Radiance sum{};
  for (std::size_t c = 0; c < 3; ++c) sum[c] = kSurroundings * static_cast<double>(texel[c] + texel[3 + c]);
  const double alpha = std::max(static_cast<double>(texel[6]), kLeastAlpha);
  for (const DistantLight& light : kLights) {
    const LocalGeometry geometry = geometry_of(normal, light.direction);
    if (geometry.cos_light <= 0.0) continue;
    const Lobe lobe = evaluate_lobe(model.brdf, model.fresnel, alpha, geometry);
    const double strength = std::numbers::pi * light.irradiance * geometry.cos_light;
    for (std::size_t c = 0; c < 3; ++c)
      sum[c] += strength * (static_cast<double>(texel[c]) / std::numbers::pi + lobe.base +
                            static_cast<double>(texel[3 + c]) * lobe.slope);
  }
  return sum;
}

}  // namespace

PictureGrid picture_grid(std::size_t width, std::size_t height, int side) {
  const auto longer = static_cast<double>(std::max(width, height));
  const double scale = static_cast<double>(side) / longer;
  const auto pixels = [&](std::size_t texels) {
    return std::max(static_cast<int>(std::lround(static_cast<double>(texels) * scale)), 1);
  };
  PictureGrid grid;
  grid.width = pixels(width);
  grid.height = pixels(height);
  grid.samples = std::clamp(static_cast<int>(std::ceil(1.0 / scale - 1e-9)), 1, kMostSamples);
  const int columns = grid.width * grid.samples, rows = grid.height * grid.samples;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      grid.texels.push_back(
          static_cast<std::uint32_t>(texel_at(y, rows, height) * width + texel_at(x, columns, width)));
  return grid;
}

std::vector<WarpTexel> samples_of(const PictureGrid& grid, const std::vector<WarpTexel>& texels) {
  std::vector<WarpTexel> samples;
  samples.reserve(grid.texels.size());
  for (const std::uint32_t texel : grid.texels) samples.push_back(texels[texel]);
  return samples;
}

Image shaded_map(const PictureGrid& grid, const std::vector<WarpTexel>& samples, const BrdfModel& model) {
  Image picture = blank_picture(grid.width, grid.height, 0.0f);
  const std::size_t columns = grid.sample_width();
  const double longer = static_cast<double>(std::max(grid.width, grid.height) * grid.samples);
  std::vector<Radiance> pixels(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::size_t x = i % columns, y = i / columns;
    const double across = (2.0 * static_cast<double>(x) + 1.0 - static_cast<double>(columns)) / longer;
    const double down =
        (2.0 * static_cast<double>(y) + 1.0 - static_cast<double>(samples.size() / columns)) / longer;
    const Radiance own =
        radiance_of(samples[i], model, unit_vector({kSteepest * across, -kSteepest * down, 1.0}));
    const auto step = static_cast<std::size_t>(grid.samples);
    Radiance& pixel = pixels[y / step * static_cast<std::size_t>(grid.width) + x / step];
    for (std::size_t c = 0; c < 3; ++c) pixel[c] += own[c];
  }
  const double share = 1.0 / static_cast<double>(grid.samples * grid.samples);
  for (std::size_t p = 0; p < pixels.size(); ++p)
    for (std::size_t c = 0; c < 3; ++c) picture.values[3 * p + c] = display_value(share * pixels[p][c]);
  return picture;
}

DisplayColor shaded_color(const WarpTexel& texel, const BrdfModel& model) {
  const Radiance radiance = radiance_of(texel, model, {0.0, 0.0, 1.0});
  return {display_value(radiance[0]), display_value(radiance[1]), display_value(radiance[2])};
}

const DisplayColor& stroke_color(std::size_t stroke) { return kStrokeColors[stroke % kStrokeColors.size()]; }

Image with_strokes(const Image& picture, const PictureGrid& grid, const std::vector<StrokePair>& strokes,
                   StrokeSide side) {
  Image marked = picture;
  for (float& value : marked.values) value = 1.0f - kDimmed + kDimmed * value;
  const std::uint32_t last = *std::ranges::max_element(grid.texels);
  std::vector<int> stroke_of(std::size_t{last} + 1, -1);
  for (std::size_t k = 0; k < strokes.size(); ++k)
    for (const std::uint32_t texel : strokes[k].*side)
      if (texel <= last) stroke_of[texel] = static_cast<int>(k);
  const auto step = static_cast<std::size_t>(grid.samples), columns = grid.sample_width();
  for (std::size_t i = 0; i < grid.texels.size(); ++i) {
    const int stroke = stroke_of[grid.texels[i]];
    if (stroke < 0) continue;
    const std::size_t pixel = i / columns / step * static_cast<std::size_t>(grid.width) + i % columns / step;
    const DisplayColor& color = stroke_color(static_cast<std::size_t>(stroke));
    std::copy(color.begin(), color.end(), &marked.values[3 * pixel]);
  }
  return marked;
}

}  // namespace remap
