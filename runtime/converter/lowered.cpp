#include "converter/lowered.hpp"

#include <algorithm>
#include <cmath>

#include "converter/emitted_order.hpp"

namespace remap {

std::size_t coefficient_count(const std::vector<int>& degrees) {
  std::size_t count = 0;
  for (const int degree : degrees) count += static_cast<std::size_t>(degree + 1);
  return count;
}

double Lowered::alpha_bound() const {
  return std::max(alpha.bound, bright ? bright->function.bound : 0.0) + alpha_seam;
}

double Lowered::specular_bound() const {
  return std::max(specular.bound, wide ? wide->specular.function.bound : 0.0) + specular_seam;
}

float value(const PiecewisePolynomial& polynomial, float alpha, float specular) {
  const float t = polynomial.pole == 0.0f ? alpha : alpha / (alpha + polynomial.pole);
  float u = t * polynomial.scale - polynomial.start;
  int cell = 0;
  if (polynomial.cell_count > 1) {
    cell = std::clamp(static_cast<int>(u), 0, polynomial.cell_count - 1);
    u = u - (static_cast<float>(cell) + 0.5f);
  }
  const float* end =
      polynomial.coefficients.data() + static_cast<std::size_t>(cell + 1) * polynomial.coefficients_a_cell();
  const float w = specular - polynomial.middle;
  float sum = 0.0f;
  for (std::size_t power = polynomial.degrees.size(); power-- > 0;) {
    const int degree = polynomial.degrees[power];
    end -= degree + 1;
    const float factor =
        in_emitted_order(end, degree, u, u * u, [](float a, float x, float b) { return a * x + b; });
    sum = power + 1 == polynomial.degrees.size() ? factor : sum * w + factor;
  }
  return sum;
}

int cell_of(const PiecewisePolynomial& polynomial, double alpha) {
  const double pole = static_cast<double>(polynomial.pole);
  const double t = pole == 0.0 ? alpha : alpha / (alpha + pole);
  const double x = t * static_cast<double>(polynomial.scale) - static_cast<double>(polynomial.start);
  return std::clamp(static_cast<int>(std::floor(x)), 0, polynomial.cell_count - 1);
}

double cell_begin(const PiecewisePolynomial& polynomial, int cell) {
  const double t = (cell + static_cast<double>(polynomial.start)) / static_cast<double>(polynomial.scale);
  const double pole = static_cast<double>(polynomial.pole);
  return pole == 0.0 ? t : pole * t / (1.0 - t);
}

}  // namespace remap
