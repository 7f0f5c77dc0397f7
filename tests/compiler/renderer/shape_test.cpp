// This file tests the torus of the preview against the definition of a torus.

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "renderer/renderer.hpp"

using namespace remap;
using std::numbers::pi;

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
