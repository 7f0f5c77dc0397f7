// This file tests measured BRDFs: a model that is written in the format of the MERL database is read back as
// the same model.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>

#include "remap/error.hpp"
#include "support/temporary_folder.hpp"
#include "warp/quadrature.hpp"
#include "warp/texture_material.hpp"

using namespace remap;

namespace {

// Returns the directions at the center of a cell, from half and difference vector (Rusinkiewicz 1998), by
// rotation of vectors. This is independent of the quadrature.
LocalGeometry geometry_of_cell(int half, int difference, int azimuth) {
  using std::numbers::pi;
  const double t = (half + 0.5) / 90.0, theta_h = t * t * pi / 2.0,
               theta_d = (difference + 0.5) / 90.0 * pi / 2.0, phi_d = (azimuth + 0.5) / 180.0 * pi;
  const std::array<double, 3> d = {std::sin(theta_d) * std::cos(phi_d), std::sin(theta_d) * std::sin(phi_d),
                                   std::cos(theta_d)};
  // The half vector is in the xz plane, so the rotation is about y.
  const auto turned = [&](const std::array<double, 3>& v) {
    return std::array{std::cos(theta_h) * v[0] + std::sin(theta_h) * v[2], v[1],
                      -std::sin(theta_h) * v[0] + std::cos(theta_h) * v[2]};
  };
  const auto in = turned(d), out = turned({-d[0], -d[1], d[2]});
  LocalGeometry geometry{};
  geometry.cos_light = in[2];
  geometry.cos_view = out[2];
  geometry.cos_half = std::cos(theta_h);
  geometry.cos_light_half = std::cos(theta_d);
  const double between = in[0] * out[0] + in[1] * out[1] + in[2] * out[2];
  geometry.half_length_2 = 2.0 + 2.0 * between;
  geometry.cos_mirror = 2.0 * in[2] * out[2] - between;
  return geometry;
}

}  // namespace

TEST_CASE("MERL: a model written as a measured BRDF is read as that model", "[warp][slow]") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "model.binary";
  constexpr std::array<double, 3> kScales = {1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};
  constexpr double kAlpha = 0.4;
  {
    std::ofstream stream(file, std::ios::binary);
    const std::array<std::int32_t, 3> counts = {90, 90, 180};
    stream.write(reinterpret_cast<const char*>(counts.data()), sizeof counts);
    for (std::size_t c = 0; c < 3; ++c) {
      std::vector<double> values;
      for (int half = 0; half < 90; ++half)
        for (int difference = 0; difference < 90; ++difference)
          for (int azimuth = 0; azimuth < 180; ++azimuth) {
            const LocalGeometry geometry = geometry_of_cell(half, difference, azimuth);
            const bool is_seen = geometry.cos_light > 0.0 && geometry.cos_view > 0.0;
            values.push_back(
                is_seen ? (static_cast<double>(c + 1) * 0.1 + evaluate_shape(Brdf::kGgx, kAlpha, geometry)) /
                              kScales[c]
                        : -1.0);
          }
      stream.write(reinterpret_cast<const char*>(values.data()),
                   static_cast<std::streamsize>(values.size() * sizeof(double)));
    }
  }
  const std::vector<float> samples = read_merl(file);
  const auto directions = half_vector_quadrature();
  REQUIRE(samples.size() == 3 * directions.size());
  double squares = 0.0, total = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const QuadratureDirection& direction = directions[i % directions.size()];
    const double value = static_cast<double>(i / directions.size() + 1) * 0.1 +
                         evaluate_shape(Brdf::kGgx, kAlpha, direction.geometry);
    squares += std::pow(static_cast<double>(samples[i]) - value, 2.0) * direction.weight;
    total += value * value * direction.weight;
  }
  CHECK(std::sqrt(squares / total) < 0.03);  // cells are one degree wide
}

TEST_CASE("MERL: other files are refused", "[warp]") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "short.binary";
  std::ofstream(file, std::ios::binary) << "short";
  CHECK_THROWS_WITH(read_merl(file), Catch::Contains("is not a BRDF of the MERL database"));
  CHECK_THROWS_WITH(read_merl(folder.path() / "none.binary"), Catch::Contains("none.binary"));
}

TEST_CASE("MERL: values that are negative, not finite or too large for a float are 0", "[warp]") {
  constexpr std::size_t kCells = 90 * 90 * 180;
  const TemporaryFolder folder;
  const auto file = folder.path() / "damaged.binary";
  const auto write_with = [&](double value) {
    std::ofstream stream(file, std::ios::binary);
    const std::array<std::int32_t, 3> counts = {90, 90, 180};
    stream.write(reinterpret_cast<const char*>(counts.data()), sizeof counts);
    const std::vector<double> values(kCells, value);
    for (int c = 0; c < 3; ++c)
      stream.write(reinterpret_cast<const char*>(values.data()),
                   static_cast<std::streamsize>(values.size() * sizeof(double)));
  };
  for (const double value :
       {-1.0, 1e300, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    write_with(value);
    CHECK(std::ranges::all_of(read_merl(file), [](float sample) { return sample == 0.0f; }));
  }
  write_with(1500.0);
  CHECK(read_merl(file).front() == Approx(1.0));
}
