#include "look/image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "core/contains.hpp"
#include "core/errors.hpp"
#include "core/input_file.hpp"
#include "texture/image_library.hpp"

namespace remap {
namespace {

// Finds red, green and blue by name, otherwise the first three channels. A single channel is all three.
std::array<std::size_t, 3> color_channels(const std::vector<std::string>& names,
                                          const std::filesystem::path& path) {
  if (names.size() == 1) return {0, 0, 0};
  std::array<std::size_t, 3> named{};
  for (std::size_t c = 0; c < named.size(); ++c)
    named[c] = static_cast<std::size_t>(std::ranges::find(names, std::string(1, "RGB"[c])) - names.begin());
  if (!contains(named, names.size())) return named;
  if (names.size() >= 3) return {0, 1, 2};
  throw input_error(path.string() + ": 2 channels found (provide R, G, B or one channel)");
}

void require_extension(const std::filesystem::path& path, const std::string& extension,
                       const std::string& expected) {
  if (path.extension() != extension)
    throw usage_error(path.string() + ": the extension must be " + extension + " (" + expected + ")");
}

// `channels` are names. If it is empty, one channel is Y and three are R, G, B.
Picture picture_of(const Image& image, const std::vector<std::string>& channels = {}) {
  const std::vector<std::string> usual =
      image.channels == 1 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  return {image.width, image.height, channels.empty() ? usual : channels, image.values};
}

}  // namespace

Image read_rgb(const std::filesystem::path& path) {
  require_regular_file(path);
  const Picture picture = image_library().read_picture(path);
  const std::array<std::size_t, 3> channels = color_channels(picture.channels, path);
  Image image{picture.width, picture.height, 3, {}};
  const std::size_t count = picture.channels.size();
  image.values.reserve(picture.values.size() / count * 3);
  for (std::size_t start = 0; start < picture.values.size(); start += count)
    for (const std::size_t channel : channels) image.values.push_back(picture.values[start + channel]);
  return image;
}

void write_exr(const std::filesystem::path& path, const Image& image,
               const std::map<std::string, std::string>& attributes,
               const std::vector<std::string>& channels) {
  require_extension(path, ".exr", "an OpenEXR file");
  image_library().write_exr(path, picture_of(image, channels), attributes);
}

void write_png(const std::filesystem::path& path, const Image& image) {
  require_extension(path, ".png", "a PNG file");
  image_library().write_png(path, picture_of(image));
}

std::string png_bytes(const Image& image) { return image_library().png_bytes(picture_of(image)); }

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
  throw usage_error("image similarity: pictures of " + std::to_string(a) + " and " + std::to_string(b) +
                    " values (each must have " + std::to_string(expected) + ")");
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
