#include "warp/quadrature.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

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

}  // namespace remap
