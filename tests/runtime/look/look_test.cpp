// This file tests the similarity of pictures against scikit-image and closed forms, and the sweep scene
// against plain geometry.
#include <cmath>
#include <limits>
#include <vector>

#include <catch2/catch.hpp>

#include "look/image.hpp"
#include "look/scene.hpp"
#include "remap/error.hpp"

using namespace remap;

namespace {

constexpr int kWidth = 32, kHeight = 24;

template <typename Function>
std::vector<float> picture(const Function& value) {
  std::vector<float> values;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) values.push_back(static_cast<float>(value(x, y)));
  return values;
}

std::vector<float> waves() {
  return picture([](int x, int y) { return 0.5 + 0.5 * std::sin(0.3 * x + 0.1 * y); });
}
std::vector<float> other_waves() {
  return picture([](int x, int y) { return 0.5 + 0.45 * std::sin(0.32 * x + 0.08 * y + 0.2); });
}
std::vector<float> grain() {
  return picture([](int x, int y) { return (x * 7 + y * 13) % 11 / 10.0; });
}

// A Golden holds the results of scikit-image 0.26 for these pictures: structural_similarity(a, b,
// data_range=1, full=True, gaussian_weights=True, sigma=1.5, use_sample_covariance=False).
struct Golden {
  double mean, top_left, middle, bottom_right, top_right;
};
constexpr Golden kWavesToWaves{0.8578487598560238, 0.9739736505735671, 0.9529733519945758, 0.3553416569450315,
                               0.7427819415943472};
constexpr Golden kWavesToGrain{0.005531302647734717, 0.3092004203144719, -0.05540938492897119,
                               0.017968541818760352, -0.17206992398494383};

// The sines of two math libraries may differ in the last digit of a float, and the map holds floats.
constexpr double kTolerance = 2e-6;

void check_golden(const std::vector<float>& a, const std::vector<float>& b, const Golden& golden) {
  CHECK(structural_similarity(a, b, kWidth, kHeight) == Approx(golden.mean).margin(kTolerance));
  const std::vector<float> map = similarity_map(a, b, kWidth, kHeight);
  CHECK(map.front() == Approx(golden.top_left).margin(kTolerance));
  CHECK(map[12 * kWidth + 16] == Approx(golden.middle).margin(kTolerance));
  CHECK(map.back() == Approx(golden.bottom_right).margin(kTolerance));
  CHECK(map[kWidth - 1] == Approx(golden.top_right).margin(kTolerance));
}

}  // namespace

TEST_CASE("image similarity: structural similarity equals the result of scikit-image") {
  check_golden(waves(), other_waves(), kWavesToWaves);
  check_golden(waves(), grain(), kWavesToGrain);
}

TEST_CASE("image similarity: it is symmetric, and 1 for equal pictures") {
  CHECK(structural_similarity(waves(), waves(), kWidth, kHeight) == Approx(1.0).epsilon(1e-12));
  CHECK(structural_similarity(waves(), grain(), kWidth, kHeight) ==
        structural_similarity(grain(), waves(), kWidth, kHeight));
}

TEST_CASE("image similarity: constant pictures differ only by their means") {
  // The similarity is (2 a b + C1) / (a^2 + b^2 + C1): Wang et al. 2004, equation (13) without variance.
  const std::vector<float> a(16, 0.25f), b(16, 0.75f);
  CHECK(structural_similarity(a, b, 4, 4) == Approx((0.375 + 1e-4) / (0.625 + 1e-4)).epsilon(1e-6));
  CHECK(rms_difference(a, b) == Approx(0.5).epsilon(1e-12));
}

TEST_CASE("image similarity: display values are sRGB, clamped in its range") {
  CHECK(display_value(0.5) == Approx(0.7353569830524495).epsilon(1e-6));
  CHECK(display_value(0.002) == Approx(0.02584).epsilon(1e-6));
  CHECK(display_value(1.0) == 1.0f);
  CHECK(display_value(1e30) == 1.0f);
  CHECK(display_value(std::numeric_limits<double>::infinity()) == 1.0f);
  CHECK(display_value(-1.0) == 0.0f);
  CHECK(display_value(std::nan("")) == 0.0f);
}

TEST_CASE("image similarity: pictures of different sizes are refused") {
  const std::vector<float> a(16), b(12);
  CHECK_THROWS_WITH(structural_similarity(a, b, 4, 4), Catch::Contains("each must have 16"));
  CHECK_THROWS_AS(rms_difference(a, b), Error);
}

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
