// This file tests Fresnel's formulas against closed forms, and equation (1) of the paper.
#include "renderer/fresnel.hpp"

#include <cmath>
#include <complex>

#include <catch2/catch.hpp>

#include "look/brdf.hpp"

using namespace remap;

namespace {

// Returns the reflectance of a conductor by complex arithmetic, as in textbooks: Snell's law with a complex
// index.
PolarisedReflectance complex_reflectance(double cosine, std::complex<double> ior) {
  const double sine_2 = 1.0 - cosine * cosine;
  const std::complex<double> root = std::sqrt(ior * ior - sine_2);
  const std::complex<double> s = (cosine - root) / (cosine + root);
  const std::complex<double> p = (ior * ior * cosine - root) / (ior * ior * cosine + root);
  return {std::norm(p), std::norm(s)};
}

}  // namespace

TEST_CASE("fresnel: along the normal it is equation (1)") {
  for (const double eta : {0.05, 0.2, 1.0, 1.5, 4.2})
    for (const double k : {0.0, 0.5, 3.0, 9.0}) {
      const double f0 = normal_reflectance({eta, k});
      // The formula with real numbers is ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2).
      CHECK(f0 == Approx(((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k)).epsilon(1e-14));
      CHECK(std::fabs(fresnel_conductor(1.0, eta, k).mean() - f0) < 1e-12);
      CHECK(std::fabs(fresnel_conductor(1.0, eta, k).p - fresnel_conductor(1.0, eta, k).s) < 1e-12);
      CHECK(normal_reflectance({eta, -k}) == f0);
    }
  for (const double ior : {1.0, 1.05, 1.333, 1.5, 2.42})
    CHECK(std::fabs(fresnel_dielectric(1.0, ior).mean() - normal_reflectance(ior)) < 1e-12);
  CHECK(normal_reflectance(1.5) == Approx(0.04).epsilon(1e-14));
}

TEST_CASE("fresnel: F0 and index are inverse of each other") {
  for (const double ior : {1.0, 1.05, 1.5, 2.5, 4.0})
    CHECK(ior_of_reflectance(normal_reflectance(ior)) == Approx(ior).epsilon(1e-13));
}

TEST_CASE("fresnel: at Brewster's angle p vanishes and s is that of the closed form") {
  for (const double ior : {1.1, 1.333, 1.5, 2.42}) {
    const double cosine = 1.0 / std::sqrt(1.0 + ior * ior);  // Brewster's angle: tan = ior
    const PolarisedReflectance found = fresnel_dielectric(cosine, ior);
    CHECK(found.p < 1e-15);
    const double root = (1.0 - ior * ior) / (1.0 + ior * ior);
    CHECK(found.s == Approx(root * root).epsilon(1e-13));
  }
}

TEST_CASE("fresnel: grazing light is reflected completely") {
  for (const double ior : {1.05, 1.5, 2.5}) CHECK(fresnel_dielectric(0.0, ior).mean() == Approx(1.0));
  for (const double k : {0.0, 1.0, 7.0}) {
    CHECK(fresnel_conductor(0.0, 0.3, k).mean() == Approx(1.0));
    CHECK(fresnel_conductor(0.0, 2.0, k).mean() == Approx(1.0));
  }
  CHECK(schlick_weight(0.0) == 1.0);
  CHECK(schlick_weight(1.0) == 0.0);
}

TEST_CASE("fresnel: a dielectric is a conductor that does not absorb") {
  for (const double ior : {1.05, 1.333, 1.5, 2.5, 4.0})
    for (double cosine = 0.02; cosine <= 1.0; cosine += 0.02) {
      const PolarisedReflectance a = fresnel_dielectric(cosine, ior), b = fresnel_conductor(cosine, ior, 0.0);
      CHECK(std::fabs(a.p - b.p) < 1e-12);
      CHECK(std::fabs(a.s - b.s) < 1e-12);
    }
}

TEST_CASE("fresnel: total reflection for an index below 1") {
  const double critical = std::sqrt(1.0 - 0.7 * 0.7);  // the sine of the critical angle is the index
  CHECK(fresnel_dielectric(critical * 0.99, 0.7).mean() == 1.0);
  CHECK(fresnel_dielectric(critical * 1.01, 0.7).mean() < 1.0);
}

TEST_CASE("fresnel: conductors agree with complex arithmetic, and stay in 0 to 1") {
  for (const double eta : {1e-6, 0.13, 0.6, 1.0, 1.9, 4.2})
    for (const double k : {0.0, 0.01, 0.5, 3.1, 8.1})
      for (double cosine = 0.01; cosine <= 1.0; cosine += 0.03) {
        const PolarisedReflectance found = fresnel_conductor(cosine, eta, k);
        const PolarisedReflectance expected = complex_reflectance(cosine, {eta, k});
        CHECK(found.s == Approx(expected.s).margin(1e-12));
        CHECK(found.p == Approx(expected.p).margin(1e-10));
        CHECK(found.p >= 0.0);
        CHECK(found.s <= 1.0 + 1e-15);
      }
}
