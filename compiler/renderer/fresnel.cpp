#include "renderer/fresnel.hpp"

#include <algorithm>
#include <cmath>

namespace remap {

double normal_reflectance(std::complex<double> ior) { return std::norm(ior - 1.0) / std::norm(ior + 1.0); }

double ior_of_reflectance(double f0) {
  const double root = std::sqrt(f0);
  return (1.0 + root) / (1.0 - root);
}

PolarisedReflectance fresnel_dielectric(double cosine, double ior) {
  const double sine_2 = std::max(0.0, 1.0 - cosine * cosine);
  const double transmitted_2 = 1.0 - sine_2 / (ior * ior);  // cos^2 of the refracted ray, by Snell's law
  if (transmitted_2 <= 0.0) return {1.0, 1.0};
  const double transmitted = std::sqrt(transmitted_2);
  const double p = (ior * cosine - transmitted) / (ior * cosine + transmitted);
  const double s = (cosine - ior * transmitted) / (cosine + ior * transmitted);
  return {p * p, s * s};
}

PolarisedReflectance fresnel_conductor(double cosine, double eta, double k) {
  // Here a + i b = sqrt(c^2 - sin^2) is the index times the cosine of the refracted ray.
  const double cosine_2 = cosine * cosine, sine_2 = std::max(0.0, 1.0 - cosine_2);
  const double real = eta * eta - k * k - sine_2;
  const double length = std::sqrt(real * real + 4.0 * eta * eta * k * k);
  const double a = std::sqrt(std::max(0.0, 0.5 * (length + real)));
  const double b_2 = std::max(0.0, 0.5 * (length - real));
  const auto square = [](double x) { return x * x; };
  const double s_whole = square(a + cosine) + b_2, p_whole = square(a * cosine + sine_2) + b_2 * cosine_2;
  const double s = s_whole == 0.0 ? 1.0 : (square(a - cosine) + b_2) / s_whole;
  const double p = p_whole == 0.0 ? s : s * (square(a * cosine - sine_2) + b_2 * cosine_2) / p_whole;
  return {p, s};
}

}  // namespace remap
