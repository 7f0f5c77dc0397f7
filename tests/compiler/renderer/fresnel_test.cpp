// This file tests Fresnel's formulas against closed forms, equation (1) of the paper, equation (2) by
// pictures (figure 20 of Sztrajman et al. 2019), and the torus of the preview against the definition of a
// torus.
#include "renderer/fresnel.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include <catch2/catch.hpp>

#include "look/brdf.hpp"
#include "reference/workflow_conversion.hpp"
#include "remap/error.hpp"
#include "renderer/renderer.hpp"

using namespace remap;
using std::numbers::pi;

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

namespace {

std::vector<double> rgb(const std::array<float, 3>& color) { return {color[0], color[1], color[2]}; }

double largest_difference(const Image& a, const Image& b) {
  REQUIRE(a.values.size() == b.values.size());
  double difference = 0.0, peak = 0.0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    difference = std::max(difference, std::fabs(static_cast<double>(a.values[i]) - b.values[i]));
    peak = std::max(peak, static_cast<double>(b.values[i]));
  }
  return difference / peak;
}

}  // namespace

TEST_CASE("equation (2): the pictures of both materials are the same to 1e-6") {
  const auto renderer = make_builtin_renderer();
  Scene scene;
  scene.resolution = 64;
  scene.light.angle = 45.0;
  for (const double f0 : {0.03, 0.04}) {
    WorkflowConversion conversion;
    conversion.metallic.dielectric_f0 = f0;
    conversion.specular.width = RoughnessEncoding::kAlpha;
    conversion.formula = ClosedFormula::kEquation2;
    for (const float metallic : {0.0f, 0.3f, 0.7f, 1.0f})
      for (const float roughness : {0.4f, 0.7f}) {
        const MetallicMaterial material{{0.9f, 0.5f, 0.1f}, metallic, roughness};
        const SpecularMaterial specular = to_specular(conversion, material);
        const Image expected = renderer->render({"mitsuba/ggx-metallic",
                                                 {{"base_color", rgb(material.base_color)},
                                                  {"metallic", {metallic}},
                                                  {"specular", {f0 / 0.08}},
                                                  {"roughness", {roughness}}}},
                                                scene);
        const Image converted = renderer->render({"mitsuba/ggx",
                                                  {{"alpha", {specular.width}},
                                                   {"f0", rgb(specular.specular)},
                                                   {"diffuse", rgb(specular.diffuse)}}},
                                                 scene);
        CHECK(largest_difference(converted, expected) < 1e-6);
      }
  }
}

namespace {

constexpr int kShapeSide = 96;

// Returns the distance from the torus by its definition, with the axis (0, sin, cos) of the tilt.
double from_torus(const Vector3& p) {
  const double tilt = kTorusTilt * pi / 180.0;
  const double height = p.y * std::sin(tilt) + p.z * std::cos(tilt);
  const double flat = std::sqrt(std::max(0.0, p.x * p.x + p.y * p.y + p.z * p.z - height * height));
  return std::hypot(flat - kTorusRadius, height) - kTubeRadius;
}

}  // namespace

TEST_CASE("shape: every point of the torus lies on it and on its ray, with the normal of its tube") {
  std::size_t hits = 0;
  for (int row = 0; row < kShapeSide; ++row)
    for (int column = 0; column < kShapeSide; ++column) {
      SurfaceHit hit{};
      if (!shape_point(Shape::kTorus, kShapeSide, column + 0.5, row + 0.5, &hit)) continue;
      ++hits;
      const Vector3 ray = camera_ray(kShapeSide, column + 0.5, row + 0.5);
      const double t = kCameraDistance - hit.position.z;
      CHECK(std::fabs(from_torus(hit.position)) < 1e-9);
      CHECK(hit.position.x == Approx(t * ray.x).margin(1e-9));
      CHECK(hit.position.y == Approx(t * ray.y).margin(1e-9));
      // If a point moves along the normal, its distance to the torus grows outwards and falls inwards.
      const auto moved = [&](double step) {
        return from_torus({hit.position.x + step * hit.normal.x, hit.position.y + step * hit.normal.y,
                           hit.position.z + step * hit.normal.z});
      };
      CHECK(moved(0.1) == Approx(0.1).margin(1e-8));
      CHECK(moved(-0.1) == Approx(-0.1).margin(1e-8));
    }
  CHECK(hits == shape_pixels(Shape::kTorus, kShapeSide).size());
  CHECK(hits > kShapeSide * kShapeSide / 5);
  SurfaceHit hit{};
  // this ray goes through the hole
  CHECK_FALSE(shape_point(Shape::kTorus, kShapeSide, 0.5 * kShapeSide, 0.5 * kShapeSide, &hit));
  CHECK(shape_pixels(Shape::kSphere, kShapeSide).size() > shape_pixels(Shape::kTorus, kShapeSide).size());
}

TEST_CASE(
    "shape: a torus shows the same left and right under a headlight, and shadows itself under another") {
  const auto renderer = make_builtin_renderer();
  const Material paint{"mitsuba/ggx", {{"alpha", {0.3}}, {"f0", {0.5}}, {"diffuse", {0.5}}}};
  const auto picture = [&](double angle) {
    return renderer->render(paint, {kShapeSide, 1, {angle, 3.0}, 0, Shape::kTorus}).values;
  };
  const auto front = picture(0.0), side = picture(75.0);
  for (std::size_t row = 0; row < kShapeSide; ++row)
    for (std::size_t column = 0; column < kShapeSide / 2; ++column)
      REQUIRE(front[row * kShapeSide + column] ==
              Approx(front[row * kShapeSide + kShapeSide - 1 - column]).epsilon(1e-5).margin(1e-9));
  // Here, the light is above the horizon but the picture is black, because the ring casts its shadow.
  std::size_t shadowed = 0;
  const double x = 3.0 * std::sin(75.0 * pi / 180.0), z = 3.0 * std::cos(75.0 * pi / 180.0);
  for (const std::uint32_t pixel : shape_pixels(Shape::kTorus, kShapeSide)) {
    SurfaceHit hit{};
    REQUIRE(shape_point(Shape::kTorus, kShapeSide, pixel % kShapeSide + 0.5, pixel / kShapeSide + 0.5, &hit));
    const double cosine = (x - hit.position.x) * hit.normal.x - hit.position.y * hit.normal.y +
                          (z - hit.position.z) * hit.normal.z;
    CHECK((side[pixel] == 0.0f) == (cosine <= 0.0 || is_shadowed(Shape::kTorus, hit, {x, 0.0, z})));
    shadowed += cosine > 0.0 && side[pixel] == 0.0f ? 1 : 0;
  }
  CHECK(shadowed > 20);
}
