#include "look/image_similarity.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "remap/error.hpp"

namespace remap {
namespace {

constexpr double kSigma = 1.5;                                              // pixels
constexpr int kRadius = 5;                                                  // 3.5 sigma, rounded
constexpr double kStableMean = 0.01 * 0.01, kStableVariance = 0.03 * 0.03;  // C1 and C2 for range 1

using Kernel = std::array<double, 2 * kRadius + 1>;

Kernel gaussian_kernel() {
  Kernel kernel{};
  double sum = 0.0;
  for (int i = -kRadius; i <= kRadius; ++i)
    sum += kernel[static_cast<std::size_t>(i + kRadius)] = std::exp(-0.5 * i * i / (kSigma * kSigma));
  for (double& weight : kernel) weight /= sum;
  return kernel;
}

// Maps a position to a line of `count` pixels that is mirrored at both ends with the last pixel repeated:
// dcba|abcd|dcba.
int mirrored(int position, int count) {
  const int period = 2 * count;
  const int within = ((position % period) + period) % period;
  return within < count ? within : period - 1 - within;
}

// Local means of these are needed: both pictures, their squares, and their product.
enum Moment { kMeanA, kMeanB, kSquareA, kSquareB, kProduct, kMomentCount };
using Moments = std::array<double, kMomentCount>;

Moments moments_of(double a, double b) { return {a, b, a * a, b * b, a * b}; }

// Convolves `lines` lines of `count` pixels. The distance of pixels in memory is `step`, the distance of
// lines is `line_step`.
std::vector<Moments> smoothed(const std::vector<Moments>& values, const Kernel& kernel, int count,
                              std::size_t step, int lines, std::size_t line_step) {
  std::vector<Moments> result(values.size());
  for (int i = 0; i < count; ++i) {
    std::array<std::size_t, 2 * kRadius + 1> sources{};
    for (int k = -kRadius; k <= kRadius; ++k)
      sources[static_cast<std::size_t>(k + kRadius)] =
          static_cast<std::size_t>(mirrored(i + k, count)) * step;
    for (int line = 0; line < lines; ++line) {
      const std::size_t start = static_cast<std::size_t>(line) * line_step;
      Moments sum{};
      for (std::size_t k = 0; k < kernel.size(); ++k)
        for (std::size_t m = 0; m < sum.size(); ++m) sum[m] += kernel[k] * values[start + sources[k]][m];
      result[start + static_cast<std::size_t>(i) * step] = sum;
    }
  }
  return result;
}

double similarity(const Moments& m) {
  const double variance_a = m[kSquareA] - m[kMeanA] * m[kMeanA];
  const double variance_b = m[kSquareB] - m[kMeanB] * m[kMeanB];
  const double covariance = m[kProduct] - m[kMeanA] * m[kMeanB];
  return (2.0 * m[kMeanA] * m[kMeanB] + kStableMean) * (2.0 * covariance + kStableVariance) /
         ((m[kMeanA] * m[kMeanA] + m[kMeanB] * m[kMeanB] + kStableMean) *
          (variance_a + variance_b + kStableVariance));
}

void require_same_size(std::size_t a, std::size_t b, std::size_t expected) {
  if (a == expected && b == expected) return;
  throw Error(ErrorKind::kUsage, "image similarity: pictures of " + std::to_string(a) + " and " +
                                     std::to_string(b) + " values (each must have " +
                                     std::to_string(expected) + ")");
}

}  // namespace

float display_value(double linear) {
  if (!(linear > 0.0)) return 0.0f;
  if (linear >= 1.0) return 1.0f;
  return static_cast<float>(linear <= 0.0031308 ? 12.92 * linear
                                                : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
}

double linear_of_display(double display) {
  return display <= 0.04045 ? display / 12.92 : std::pow((display + 0.055) / 1.055, 2.4);
}

double rms_difference(std::span<const float> a, std::span<const float> b) {
  require_same_size(a.size(), b.size(), a.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
    sum += difference * difference;
  }
  return a.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(a.size()));
}

std::vector<float> similarity_map(std::span<const float> a, std::span<const float> b, int width, int height) {
  const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  require_same_size(a.size(), b.size(), columns * rows);
  std::vector<Moments> moments(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    moments[i] = moments_of(static_cast<double>(a[i]), static_cast<double>(b[i]));
  const Kernel kernel = gaussian_kernel();
  moments = smoothed(moments, kernel, width, 1, height, columns);
  moments = smoothed(moments, kernel, height, columns, width, 1);
  std::vector<float> map(a.size());
  for (std::size_t i = 0; i < map.size(); ++i) map[i] = static_cast<float>(similarity(moments[i]));
  return map;
}

double structural_similarity(std::span<const float> a, std::span<const float> b, int width, int height) {
  const std::vector<float> map = similarity_map(a, b, width, height);
  const bool framed = width > 2 * kRadius && height > 2 * kRadius;
  const int frame = framed ? kRadius : 0;
  double sum = 0.0;
  for (int row = frame; row < height - frame; ++row)
    for (int column = frame; column < width - frame; ++column)
      sum += static_cast<double>(map[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                     static_cast<std::size_t>(column)]);
  return sum / ((width - 2.0 * frame) * (height - 2.0 * frame));
}

}  // namespace remap
