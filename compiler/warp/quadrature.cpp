#include "warp/quadrature.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "core/errors.hpp"
#include "core/input_file.hpp"

namespace remap {
namespace {

using std::numbers::pi;

constexpr std::size_t kHalfAngles = 20, kAzimuths = 5;
constexpr double kLeastTangent = 0.004, kLargestHalfAngle = 86.0 / 180.0 * pi;
constexpr double kLeastCosine = 0.05;

// These are Gauss-Legendre nodes and weights on [-1, 1] (Abramowitz and Stegun 1964, table 25.4).
constexpr std::array<double, 5> kGaussNodes = {-0.906179845938664, -0.538469310105683, 0.0, 0.538469310105683,
                                               0.906179845938664};
constexpr std::array<double, 5> kGaussWeights = {0.236926885056189, 0.478628670499366, 0.568888888888889,
                                                 0.478628670499366, 0.236926885056189};

LocalGeometry geometry_of(double half_angle, double difference_angle, double azimuth) {
  const double cos_half = std::cos(half_angle), sin_half = std::sin(half_angle);
  const double cos_difference = std::cos(difference_angle), sin_difference = std::sin(difference_angle);
  const double across = sin_difference * std::cos(azimuth) * sin_half, along = cos_difference * cos_half;
  LocalGeometry geometry{};
  geometry.cos_light = along - across;
  geometry.cos_view = along + across;
  geometry.cos_half = cos_half;
  geometry.cos_light_half = cos_difference;
  geometry.half_length_2 = 4.0 * cos_difference * cos_difference;
  const double cos_between = 2.0 * cos_difference * cos_difference - 1.0;
  geometry.cos_mirror = 2.0 * geometry.cos_light * geometry.cos_view - cos_between;
  return geometry;
}

// A file of the MERL database (Matusik et al. 2003) has three 32-bit counts (90 half angles, 90 difference
// angles, 180 azimuths). Then it has a 64-bit value of red for each cell, then of green, then of blue. All
// numbers are little-endian.
static_assert(std::endian::native == std::endian::little, "the file format is little-endian");

constexpr std::array<std::int32_t, 3> kCounts = {90, 90, 180};
constexpr std::size_t kCells = 90 * 90 * 180;
constexpr std::size_t kFileBytes = sizeof kCounts + 3 * kCells * sizeof(double);
constexpr std::array<double, 3> kScales = {1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};

std::size_t cell(double share, std::int32_t count) {
  return static_cast<std::size_t>(std::clamp(static_cast<std::int32_t>(share * count), 0, count - 1));
}

// Returns the cell of a direction. Half angles have cells of equal size in the square root of the angle.
std::size_t cell_of(const QuadratureDirection& direction) {
  const std::size_t half = cell(std::sqrt(direction.half_angle / (pi / 2.0)), kCounts[0]),
                    difference = cell(direction.difference_angle / (pi / 2.0), kCounts[1]),
                    azimuth = cell(direction.azimuth / pi, kCounts[2]);
  return (half * 90 + difference) * 180 + azimuth;
}

}  // namespace

std::vector<QuadratureDirection> half_vector_quadrature() {
  std::vector<QuadratureDirection> directions;
  const double start = std::log(kLeastTangent), end = std::log(std::tan(kLargestHalfAngle));
  for (std::size_t h = 0; h < kHalfAngles; ++h) {
    const double share = static_cast<double>(h) / static_cast<double>(kHalfAngles - 1);
    const double half_angle = std::atan(std::exp(start + share * (end - start)));
    // d(angle) = sin cos d(log tan), times the sine of the solid angle.
    const double half_measure = std::pow(std::sin(half_angle), 2.0) * std::cos(half_angle);
    for (std::size_t d = 0; d < kGaussNodes.size(); ++d) {
      const double difference_angle = (kGaussNodes[d] + 1.0) * pi / 4.0;
      const double measure =
          half_measure * kGaussWeights[d] * std::sin(difference_angle) * 4.0 * std::cos(difference_angle);
      for (std::size_t a = 0; a < kAzimuths; ++a) {
        const double azimuth = (static_cast<double>(a) + 0.5) / static_cast<double>(kAzimuths) * pi;
        const LocalGeometry geometry = geometry_of(half_angle, difference_angle, azimuth);
        if (geometry.cos_light < kLeastCosine || geometry.cos_view < kLeastCosine) continue;
        directions.push_back({half_angle, difference_angle, azimuth, geometry, measure * geometry.cos_light});
      }
    }
  }
  return directions;
}

std::vector<float> read_merl(const std::filesystem::path& file) {
  const InputFile input(file);
  std::array<std::int32_t, 3> counts{};
  input.read(0, reinterpret_cast<char*>(counts.data()), sizeof counts);
  const bool is_merl = input.size() == kFileBytes && counts == kCounts;
  std::vector<double> values(is_merl ? 3 * kCells : 0);
  const std::size_t bytes = values.size() * sizeof(double);
  if (!is_merl || input.read(sizeof counts, reinterpret_cast<char*>(values.data()), bytes) != bytes)
    throw input_error(file.string() +
                      ": is not a BRDF of the MERL database (90 x 90 x 180 cells of three channels)");
  std::vector<float> samples;
  for (std::size_t c = 0; c < kScales.size(); ++c)
    for (const QuadratureDirection& direction : half_vector_quadrature()) {
      const double value = kScales[c] * values[c * kCells + cell_of(direction)];
      // If a value is above the largest float, the file is as damaged as with an infinite value.
      const bool is_measured = value > 0.0 && value <= std::numeric_limits<float>::max();
      samples.push_back(is_measured ? static_cast<float>(value) : 0.0f);
    }
  return samples;
}

}  // namespace remap
