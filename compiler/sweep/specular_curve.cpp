#include "sweep/specular_curve.hpp"

#include <cmath>
#include <numbers>

namespace remapc {

std::vector<double> curve_points(const remap::Range& range, std::size_t count) {
  std::vector<double> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = std::numbers::pi * static_cast<double>(i) / static_cast<double>(count - 1);
    points.push_back(range.min + (range.max - range.min) * 0.5 * (1.0 - std::cos(turn)));
  }
  points.back() = range.max;
  return points;
}

std::vector<float> curve_picture(const std::vector<double>& nodes,
                                 const std::vector<std::vector<float>>& pictures, double specular) {
  std::vector<double> sums(pictures.front().size());
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    double weight = 1.0;  // Lagrange's basis
    for (std::size_t j = 0; j < nodes.size(); ++j)
      if (j != k) weight *= (specular - nodes[j]) / (nodes[k] - nodes[j]);
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += weight * static_cast<double>(pictures[k][i]);
  }
  return std::vector<float>(sums.begin(), sums.end());
}

}  // namespace remapc
