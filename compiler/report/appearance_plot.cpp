#include "report/appearance_plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace remapc {
namespace {

constexpr float kPlotPaper = 0.97f, kLine = 0.85f;

// The first two coordinates of row `i`.
std::array<double, 2> place_of(const Points& positions, Eigen::Index i) {
  const double golden = 0.6180339887498949 * static_cast<double>(i);
  return {positions(i, 0), positions.cols() > 1 ? positions(i, 1) : golden - std::floor(golden) - 0.5};
}

// Draws an antialiased disc.
void draw_disc(double x, double y, double radius, const DisplayColor& color, Image* picture) {
  const int left = std::max(static_cast<int>(std::floor(x - radius - 1.0)), 0);
  const int right = std::min(static_cast<int>(std::ceil(x + radius + 1.0)), picture->width - 1);
  const int top = std::max(static_cast<int>(std::floor(y - radius - 1.0)), 0);
  const int bottom = std::min(static_cast<int>(std::ceil(y + radius + 1.0)), picture->height - 1);
  for (int row = top; row <= bottom; ++row)
    for (int column = left; column <= right; ++column) {
      const double distance = std::hypot(column + 0.5 - x, row + 0.5 - y);
      const auto cover = static_cast<float>(std::clamp(radius + 0.5 - distance, 0.0, 1.0));
      float* pixel = &picture->values[3 * static_cast<std::size_t>(row * picture->width + column)];
      for (std::size_t c = 0; c < 3; ++c) pixel[c] += cover * (color[c] - pixel[c]);
    }
}

void draw_lines(const PlotBox& box, double scale, Image* picture) {
  const auto column = static_cast<int>(std::floor((box.half_width - box.x) * scale));
  const auto row = static_cast<int>(std::floor((box.half_height + box.y) * scale));
  const auto mark = [&](int x, int y) {
    std::fill_n(&picture->values[3 * static_cast<std::size_t>(y * picture->width + x)], 3, kLine);
  };
  for (int y = 0; y < picture->height && column >= 0 && column < picture->width; ++y) mark(column, y);
  for (int x = 0; x < picture->width && row >= 0 && row < picture->height; ++x) mark(x, row);
}

}  // namespace

PlotBox box_around(const std::vector<PlottedPoints>& layers) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<double, 2> low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
  for (const PlottedPoints& layer : layers)
    for (Eigen::Index i = 0; i < layer.positions.rows(); ++i) {
      const std::array<double, 2> place = place_of(layer.positions, i);
      for (std::size_t k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], place[k]);  // NaN changes neither
        high[k] = std::max(high[k], place[k]);
      }
    }
  if (!(low[0] <= high[0] && low[1] <= high[1])) return {};
  const double height = high[1] - low[1], width = std::max({high[0] - low[0], height, 1e-6});
  return {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.525 * width,
          0.525 * std::max(height, width / 3.0)};
}

Image appearance_plot(const std::vector<PlottedPoints>& layers, const PlotBox& box, int width) {
  const double scale = 0.5 * static_cast<double>(width) / box.half_width;
  Image picture =
      blank_picture(width, static_cast<int>(std::lround(2.0 * scale * box.half_height)), kPlotPaper);
  draw_lines(box, scale, &picture);
  for (const PlottedPoints& layer : layers)
    for (Eigen::Index i = 0; i < layer.positions.rows(); ++i) {
      const std::array<double, 2> place = place_of(layer.positions, i);
      if (!std::isfinite(place[0]) || !std::isfinite(place[1])) continue;
      const double x = (place[0] - box.x + box.half_width) * scale;
      const double y = (box.half_height - place[1] + box.y) * scale;
      const std::size_t color = layer.colors.size() == 1 ? 0 : static_cast<std::size_t>(i);
      if (std::abs(x) < 1e6 && std::abs(y) < 1e6)
        draw_disc(x, y, layer.radius, layer.colors[color], &picture);
    }
  return picture;
}

}  // namespace remapc
