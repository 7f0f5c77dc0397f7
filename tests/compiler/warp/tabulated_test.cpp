// This file compares features by samples and tabulated materials with parametric materials, and with
// profiles whose distance is known. A model that is written in the format of the MERL database is read
// back as the same model.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>

#include "look/brdf.hpp"
#include "remap/error.hpp"
#include "support/temporary_folder.hpp"
#include "support/warp_sets.hpp"
#include "warp/features.hpp"
#include "warp/quadrature.hpp"
#include "warp/texture_material.hpp"
#include "warp/warp.hpp"

using namespace remap;

namespace {

using namespace remap;

// Evaluates a material into a table with one entry per texel.
TabulatedMaterial tabulated(const WarpMaterial& material) {
  const auto directions = half_vector_quadrature();
  const auto rows = static_cast<Eigen::Index>(directions.size());
  TabulatedMaterial table;
  table.name = material.name;
  table.samples.resize(3 * rows, static_cast<Eigen::Index>(material.texels.size()));
  for (std::size_t i = 0; i < material.texels.size(); ++i) {
    const WarpTexel& texel = material.texels[i];
    for (Eigen::Index row = 0; row < rows; ++row) {
      const Lobe lobe =
          evaluate_lobe(material.model.brdf, material.model.fresnel, static_cast<double>(texel[6]),
                        directions[static_cast<std::size_t>(row)].geometry);
      for (std::size_t c = 0; c < 3; ++c)
        table.samples(static_cast<Eigen::Index>(c) * rows + row, static_cast<Eigen::Index>(i)) =
            static_cast<float>(static_cast<double>(texel[c]) / std::numbers::pi + lobe.base +
                               static_cast<double>(texel[3 + c]) * lobe.slope);
    }
    table.entries.push_back(static_cast<std::uint32_t>(i));
  }
  return table;
}

// Returns the RMS distance of the copies from the correct result, as a fraction of the template's spread. The
// distance is AppearanceDistance::kRelative.
double error_of(const WarpSet& set, const AppearanceMatch& match, const MaterialRef& source,
                const MaterialRef& target) {
  const FeaturePair features = appearance_features(set.source, set.target);
  const double radius = appearance_space(set.target, features.target).radius;
  const auto copy = copy_exactly(match, source, target);
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < copy.size(); i += 5, count += 1.0)
    sum += (features_of(features.target, set.target.texels[copy[i]]) -
            features_of(features.target, set.truth[i]))
               .squaredNorm();
  return std::sqrt(sum / count) / radius;
}

// Returns profiles albedo * exp(-r / l) / (2 pi l^2), whose integral over the plane is the albedo.
TabulatedMaterial profiles(const std::vector<double>& radii,
                           const std::vector<std::array<double, 2>>& albedo_and_length) {
  TabulatedMaterial material;
  material.name = "wax";
  material.radii = radii;
  const auto rows = static_cast<Eigen::Index>(radii.size());
  material.samples.resize(3 * rows, static_cast<Eigen::Index>(albedo_and_length.size()));
  for (std::size_t i = 0; i < albedo_and_length.size(); ++i) {
    const auto [albedo, length] = albedo_and_length[i];
    for (Eigen::Index row = 0; row < 3 * rows; ++row)
      material.samples(row, static_cast<Eigen::Index>(i)) =
          static_cast<float>(albedo * std::exp(-radii[static_cast<std::size_t>(row % rows)] / length) /
                             (2.0 * std::numbers::pi * length * length));
    material.entries.push_back(static_cast<std::uint32_t>(i));
  }
  return material;
}

std::vector<double> even_radii(double step, std::size_t count) {
  std::vector<double> radii;
  for (std::size_t i = 1; i <= count; ++i) radii.push_back(step * static_cast<double>(i));
  return radii;
}

}  // namespace

TEST_CASE("sampled features: distances are the integral over directions", "[warp]") {
  const WarpSet set = rust_set(32);
  const TabulatedMaterial a = tabulated(set.source), b = tabulated(set.target);
  const auto relative = AppearanceDistance::kRelative;
  const Eigen::VectorXd weights = direction_weights(set.source, set.target, relative);
  const FeaturePair features = sampled_features(set.source, set.target, relative, weights);
  for (Eigen::Index i = 0; i < 30; ++i) {
    const Eigen::Index first = 31 * i, second = 17 * i + 5, rows = a.samples.rows() / 3;
    double sum = 0.0;
    for (Eigen::Index row = 0; row < a.samples.rows(); ++row)
      sum += std::pow(
          weights[row % rows] * static_cast<double>(a.samples(row, first) - b.samples(row, second)), 2.0);
    const double found = (features_of(features.source, set.source.texels[static_cast<std::size_t>(first)]) -
                          features_of(features.target, set.target.texels[static_cast<std::size_t>(second)]))
                             .norm();
    CHECK(found == Approx(std::sqrt(sum)).epsilon(0.01));
  }
}

TEST_CASE("dielectrics: exact Fresnel reflectance is near Schlick's, and finds the same correspondence",
          "[warp][slow]") {
  const WarpSet set = leaf_set(64);
  WarpSet exact = set;
  const MapModel model = builtin_map_model("mitsuba/ggx-dielectric");
  exact.target.model = model.lobe;
  exact.target.is_dielectric = model.is_dielectric;
  // Compares the features of the same texel. kPlain is used, because it does not depend on the other
  // material.
  const FeaturePair pair = appearance_features(set.target, exact.target, AppearanceDistance::kPlain);
  const WarpTexel texel = set.target.texels[1234];
  const Eigen::VectorXd by_schlick = features_of(pair.source, texel),
                        by_fresnel = features_of(pair.target, texel);
  const double difference = (by_schlick - by_fresnel).norm() / by_schlick.norm();
  CHECK(difference > 1e-4);
  CHECK(difference < 0.1);
  const auto strokes = strokes_of(set, 0);
  const double schlick = error_of(set, fit_warp(set.source, set.target, strokes), set.source, set.target);
  const WarpFit fit = fit_warp(set.source, exact.target, strokes);
  const double fresnel = error_of(set, fit, set.source, exact.target);
  CAPTURE(schlick, fresnel, fit.diagnostics.coordinates_error);
  CHECK(std::abs(schlick - fresnel) < 0.05);
  CHECK(fit.diagnostics.coordinates_error < 0.03);
}

TEST_CASE("models for maps: all models of the renderer except conductors", "[warp]") {
  CHECK(builtin_map_model("mitsuba/as-ior").lobe == BrdfModel{Brdf::kAs, Fresnel::kSchlick});
  CHECK(builtin_map_model("mitsuba/ward-conserving").lobe == BrdfModel{Brdf::kWard, Fresnel::kNone});
  CHECK(builtin_map_model("mitsuba/beckmann-metallic").lobe == BrdfModel{Brdf::kBeckmann, Fresnel::kSchlick});
  CHECK(builtin_map_model("mitsuba/beckmann-dielectric").is_dielectric);
  CHECK_THROWS_WITH(builtin_map_model("mitsuba/ggx-conductor"), Catch::Contains("the index of a conductor"));
  CHECK_THROWS_WITH(builtin_map_model("mitsuba/gxx"), Catch::Contains("mitsuba/ggx"));
}

TEST_CASE("tables: a tabulated material has the positions of its parameters", "[warp][slow]") {
  const WarpSet set = leaf_set(48);
  const auto strokes = strokes_of(set, 0);
  const TabulatedMaterial source = tabulated(set.source), target = tabulated(set.target);
  const double by_parameters =
      error_of(set, match_appearances(set.source, set.target, strokes), set.source, set.target);
  const double from_table = error_of(set, match_appearances(source, set.target, strokes), source, set.target);
  const double to_table = error_of(set, match_appearances(set.source, target, strokes), set.source, target);
  const double both = error_of(set, match_appearances(source, target, strokes), source, target);
  CAPTURE(by_parameters, from_table, to_table, both);
  for (const double error : {from_table, to_table, both}) CHECK(std::abs(error - by_parameters) < 0.03);
}

TEST_CASE("profiles: the distance of section 4, for different radii", "[warp]") {
  const auto coarse = even_radii(0.02, 400), fine = even_radii(0.013, 700);
  const TabulatedMaterial a = profiles(coarse, {{0.8, 0.5}, {0.5, 0.3}}),
                          b = profiles(fine, {{0.6, 0.4}, {0.2, 0.7}});
  const FeaturePair pair = appearance_features(a, b, AppearanceDistance::kPlain);
  const auto& from = std::get<SampledFeatures>(pair.source);
  const auto& to = std::get<SampledFeatures>(pair.target);
  const Eigen::VectorXd first = features_of_samples(from, samples_of(from, a, 0)),
                        second = features_of_samples(to, samples_of(to, b, 0));
  // The expected value is the integral of (p exp(-r / l) - q exp(-r / m))^2 r dr, the same for three
  // channels.
  const double l = 0.5, m = 0.4, p = 0.8 / (2.0 * std::numbers::pi * l * l),
               q = 0.6 / (2.0 * std::numbers::pi * m * m);
  const double joint = 1.0 / l + 1.0 / m;
  const double squares = 3.0 * (p * p * l * l / 4.0 + q * q * m * m / 4.0 - 2.0 * p * q / (joint * joint));
  CHECK((first - second).squaredNorm() == Approx(squares).epsilon(0.01));
}

TEST_CASE("tables: incompatible materials are refused", "[warp]") {
  const WarpSet set = leaf_set(32);
  const TabulatedMaterial wax = profiles(even_radii(0.1, 20), {{0.8, 0.5}, {0.5, 0.3}});
  CHECK_THROWS_WITH(appearance_features(set.source, wax, AppearanceDistance::kPlain),
                    Catch::Contains("one contains scattering profiles and the other reflectance"));
  CHECK_THROWS_WITH(appearance_features(wax, wax, AppearanceDistance::kRelative),
                    Catch::Contains("choose plain"));
  TabulatedMaterial damaged = wax;
  damaged.samples(3, 1) = -1.0f;
  CHECK_THROWS_WITH(match_appearances(damaged, wax, {{{0}, {0}}}, AppearanceDistance::kPlain),
                    Catch::Contains("negative or not finite"));
}

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
