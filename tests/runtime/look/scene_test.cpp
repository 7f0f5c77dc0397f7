// This file tests the sweep scene against plain geometry.
#include "look/scene.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace remap;

TEST_CASE("scene: the middle of the image shows the pole of the sphere") {
  Vector3 point;
  REQUIRE(sphere_point(100, 50.0, 50.0, &point));
  CHECK(point.x == Approx(0.0).margin(1e-15));
  CHECK(point.y == Approx(0.0).margin(1e-15));
  CHECK(point.z == Approx(1.0));
}

TEST_CASE("scene: row 0 is the top and column 0 is -x") {
  Vector3 point;
  REQUIRE(sphere_point(100, 25.0, 50.0, &point));
  CHECK(point.x < 0.0);
  REQUIRE(sphere_point(100, 50.0, 25.0, &point));
  CHECK(point.y > 0.0);
}

TEST_CASE("scene: every point lies on the unit sphere and on its ray") {
  for (double column = 0.5; column < 64.0; column += 7.0) {
    for (double row = 0.5; row < 64.0; row += 5.0) {
      Vector3 p;
      if (!sphere_point(64, column, row, &p)) continue;
      CHECK(p.x * p.x + p.y * p.y + p.z * p.z == Approx(1.0).epsilon(1e-12));
      // The slope of the ray follows from the projection: half the image spans tan(asin(1/3)).
      const double slope = std::tan(std::asin(1.0 / 3.0)) * (column / 32.0 - 1.0);
      CHECK(p.x / (3.0 - p.z) == Approx(slope).margin(1e-12));
    }
  }
}

TEST_CASE("scene: the sphere fills the image to its edges and not its corners") {
  Vector3 point;
  CHECK(sphere_point(1000, 0.01, 500.0, &point));
  CHECK_FALSE(sphere_point(1000, 0.5, 0.5, &point));
}

TEST_CASE("scene: view cosines fall from 1 in the middle to 0 at the rim") {
  const auto cosines = view_cosines(65, 1);
  CHECK(cosines[32 * 65 + 32] == Approx(1.0));
  CHECK(cosines[32 * 65 + 32] > cosines[32 * 65 + 50]);
  CHECK(cosines[0] == 0.0f);
  const auto averaged = view_cosines(65, 4);
  CHECK(averaged[32 * 65 + 50] == Approx(cosines[32 * 65 + 50]).epsilon(1e-2));
}

TEST_CASE("scene: lights are named by angle and by a distance that is not 3") {
  CHECK(light_name({0.0, 3.0}) == "headlight");
  CHECK(light_name({60.0, 3.0}) == "60");
  CHECK(light_name({45.0, 10.0}) == "45@10");
}
