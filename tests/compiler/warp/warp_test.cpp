// This file tests warps on materials with a known result, with a brute-force quadrature, and on cases with an
// exact result.
#include "warp/warp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "lower/fit_file.hpp"
#include "remap/error.hpp"
#include "support/error_of.hpp"
#include "support/random_warp.hpp"
#include "support/warp_sets.hpp"
#include "warp/quadrature.hpp"
#include "warp/warp_table.hpp"

namespace {

using namespace remap;

// Returns the distance by direct quadrature of the BRDF at both alphas, which is independent of the tables.
double brute_distance(const Eigen::VectorXd& weights, const WarpTexel& a, const WarpTexel& b) {
  const auto directions = half_vector_quadrature();
  const auto reflectance = [](const WarpTexel& texel, std::size_t c, const LocalGeometry& geometry) {
    const Lobe lobe = evaluate_lobe(Brdf::kGgx, Fresnel::kSchlick, static_cast<double>(texel[6]), geometry);
    return static_cast<double>(texel[c]) / 3.14159265358979 + lobe.base +
           static_cast<double>(texel[3 + c]) * lobe.slope;
  };
  double sum = 0.0;
  for (std::size_t i = 0; i < directions.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      sum += std::pow(weights[static_cast<Eigen::Index>(i)] * (reflectance(a, c, directions[i].geometry) -
                                                               reflectance(b, c, directions[i].geometry)),
                      2.0);
  return std::sqrt(sum);
}

// Figures holds the figures of a fit on a set, in % of the template's spread unless stated otherwise.
struct Figures {
  double error = 0.0;        // distance of the exact copy from the correct result
  double table_error = 0.0;  // distance of the compiled converter from the exact copy
  double bins = 0.0;         // fraction of the template's occupied bins that the copy uses
  double folds = 0.0;        // fraction of texels
  std::vector<Eigen::VectorXd> result;
};

Figures measure(const WarpSet& set, const WarpFit& fit) {
  const FeaturePair features = appearance_features(set.source, set.target);
  const auto copy = copy_exactly(fit, set.source, set.target);
  const Points positions = positions_of(fit.target_coordinates(), set.target.texels);
  const BinGrid grid(positions, occupancy_of(positions, {}).spacing);
  std::vector<int> count(grid.size(), 0), used(grid.size(), 0);
  for (Eigen::Index i = 0; i < positions.rows(); ++i)
    ++count[static_cast<std::size_t>(grid.bin_of(positions, i))];
  for (const std::uint32_t texel : copy) used[static_cast<std::size_t>(grid.bin_of(positions, texel))] = 1;
  double occupied = 0.0, reached = 0.0;
  for (std::size_t bin = 0; bin < count.size(); ++bin)
    if (count[bin] >= 4) {
      occupied += 1.0;
      reached += used[bin];
    }
  Figures figures;
  figures.bins = reached / occupied;
  std::vector<WarpTexel> some;
  for (std::size_t i = 0; i < copy.size(); i += 13) {
    some.push_back(set.source.texels[i]);
    const auto own = features_of(features.target, set.target.texels[copy[i]]);
    const auto compiled = features_of(features.target, evaluate_warp(fit.compiled, set.source.texels[i]));
    figures.error += (own - features_of(features.target, set.truth[i])).norm();
    figures.table_error += (own - compiled).norm();
    figures.result.push_back(own);
  }
  const double scale = 100.0 / fit.target_radius / static_cast<double>(some.size());
  figures.error *= scale;
  figures.table_error *= scale;
  const Points points = positions_of(fit.compiled.coordinates, some);
  figures.folds = fold_share(fit.warp, points, Eigen::VectorXd::Ones(points.rows()));
  return figures;
}

// Returns the fraction of torn texels. A texel is torn if its result and the result of its neighbor in the
// source's appearance space are more than a quarter of the spread apart.
double tears(const WarpSet& set, const WarpFit& fit) {
  const FeaturePair features = appearance_features(set.source, set.target);
  const auto copy = copy_exactly(fit, set.source, set.target);
  const Points positions = positions_of(fit.compiled.coordinates, set.source.texels);
  Points beside = positions;
  beside.col(0).array() += 0.02;
  const auto neighbours = nearest_texels(positions, beside);
  double torn = 0.0, count = 0.0;
  for (std::size_t i = 0; i < copy.size(); i += 13, count += 1.0) {
    const auto own = features_of(features.target, set.target.texels[copy[i]]);
    const auto other = features_of(features.target, set.target.texels[copy[neighbours[i]]]);
    torn += (own - other).norm() > 0.25 * fit.target_radius ? 1.0 : 0.0;
  }
  return torn / count;
}

double change(const Figures& a, const Figures& b, double radius) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.result.size(); ++i) sum += (a.result[i] - b.result[i]).norm();
  return 100.0 * sum / radius / static_cast<double>(a.result.size());
}

WarpSet small_leaf() { return leaf_set(64); }

}  // namespace

TEST_CASE("features: distances equal those of the quadrature", "[warp]") {
  const WarpSet set = rust_set(64);
  const FeaturePair features = appearance_features(set.source, set.target);
  const Eigen::VectorXd weights = direction_weights(set.source, set.target, AppearanceDistance::kRelative);
  for (std::size_t i = 0; i < 40; ++i) {
    const auto &a = set.source.texels[97 * i], &b = set.target.texels[53 * i + 7];
    const double distance = (features_of(features.source, a) - features_of(features.target, b)).norm();
    // Interpolation between the 64 nodes of alpha has an error of 1e-3 of a lobe. The basis of 14 has a
    // smaller error.
    CHECK(distance == Approx(brute_distance(weights, a, b)).epsilon(5e-3));
  }
}

TEST_CASE("coordinates: closed form is the projection of features", "[warp]") {
  const WarpSet set = rust_set(64);
  const FeaturePair features = appearance_features(set.source, set.target);
  const AppearanceSpace space = appearance_space(set.source, features.source);
  const auto coordinates = closed_form(space, std::get<SeparableFeatures>(features.source), 3);
  for (std::size_t i = 0; i < set.source.texels.size(); i += 101) {
    const Eigen::VectorXd projected = space.axes.transpose() *
                                      (features_of(features.source, set.source.texels[i]) - space.mean) /
                                      space.radius;
    const auto position = coordinates_of(coordinates, set.source.texels[i]);
    for (std::size_t k = 0; k < 3; ++k)  // the tables hold floats
      CHECK(position[k] == Approx(projected[static_cast<Eigen::Index>(k)]).margin(1e-5));
  }
  CHECK(dimension_of(space) == 3);
  CHECK(space.stress[2] < 0.01);
  const WarpSet leaf = small_leaf();
  const FeaturePair leaf_features = appearance_features(leaf.source, leaf.target);
  const AppearanceSpace leaf_space = appearance_space(leaf.source, leaf_features.source);
  CHECK(dimension_of(leaf_space) == 2);
  CHECK(leaf_space.stress[1] < 0.03);
}

TEST_CASE("affine: strokes related by an affine map give that map", "[warp]") {
  PointSets sets;
  sets.common_axes = Eigen::MatrixXd::Identity(2, 2);
  sets.source_centres = Points(4, 2);
  sets.source_centres << -90, -80, 100, -70, -60, 110, 80, 90;  // large values make the prior negligible
  Eigen::MatrixXd linear(2, 2);
  linear << 0.5, 1.25, -2.0, 0.75;
  const Eigen::RowVectorXd offset = Eigen::RowVector2d(3.0, -4.0);
  sets.target_centres = (sets.source_centres * linear).rowwise() + offset;
  const AffineMap found = affine_from_strokes(sets);
  CHECK((found.linear - linear).norm() < 1e-4);
  CHECK((found.offset - offset).norm() < 1e-2);
}

TEST_CASE("affine: with one stroke the map follows the common axes", "[warp]") {
  PointSets sets;
  sets.common_axes = Eigen::MatrixXd::Identity(2, 2);
  sets.source_centres = Eigen::RowVector2d(0.5, 0.25);
  sets.target_centres = Eigen::RowVector2d(-0.5, 0.75);
  const AffineMap found = affine_from_strokes(sets);
  CHECK((found.linear - sets.common_axes).norm() < 1e-12);
  CHECK((found.offset - Eigen::RowVector2d(-1.0, 0.5)).norm() < 1e-12);
}

TEST_CASE("warp: near the truth, without tears and folds", "[warp][slow]") {
  for (const WarpSet& set : {leaf_set(128), rust_set(128)}) {
    CAPTURE(set.name);
    std::vector<Figures> figures;
    double error = 0.0, bins = 0.0, moved = 0.0, radius = 0.0;
    for (std::uint32_t seed = 0; seed < 3; ++seed) {
      const WarpFit fit = fit_warp(set.source, set.target, strokes_of(set, seed));
      figures.push_back(measure(set, fit));
      CHECK(figures.back().folds == 0.0);
      CHECK(tears(set, fit) <= 0.01);
      CHECK(figures.back().table_error <
            3.0);  // with few texels, neighbors are farther apart than in a map of 256^2
      CHECK(byte_count(fit.compiled) <= 250000);
      error += figures.back().error / 3.0;
      bins += figures.back().bins / 3.0;
      radius = fit.target_radius;
    }
    for (std::size_t k = 0; k < 3; ++k) moved += change(figures[k], figures[(k + 1) % 3], radius) / 3.0;
    CAPTURE(error, bins, moved);
    CHECK(error < 24.0);  // unrelated texels would give 141
    CHECK(bins > 0.8);
    CHECK(moved < 14.0);
  }
}

TEST_CASE("warp: results are bit-identical in every run", "[warp]") {
  const WarpSet set = small_leaf();
  const auto strokes = strokes_of(set, 0);
  CHECK(fit_warp(set.source, set.target, strokes).compiled ==
        fit_warp(set.source, set.target, strokes).compiled);
}

TEST_CASE("warp: other BRDF models keep the appearance", "[warp]") {
  WarpSet set = small_leaf();
  set.source.model = {Brdf::kBeckmann, Fresnel::kSchlick};
  const WarpFit fit = fit_warp(set.source, set.target, strokes_of(set, 0));
  CHECK(measure(set, fit).folds == 0.0);
}

TEST_CASE("warp: an exact table gives only texels of the template, about as near to the copy as blends",
          "[warp][slow]") {
  const WarpSet set = leaf_set(128);
  const auto strokes = strokes_of(set, 0);
  const WarpFit exact = fit_warp(set.source, set.target, strokes, AppearanceDistance::kRelative, true),
                blended = fit_warp(set.source, set.target, strokes);
  const auto& entries = std::get<CopiedNodes>(exact.compiled.table.entries);
  CHECK(exact.compiled.table.nodes == 256);
  std::vector<WarpTexel> texels = set.target.texels;
  std::sort(texels.begin(), texels.end());
  for (const WarpTexel& texel : entries.palette)
    REQUIRE(std::binary_search(texels.begin(), texels.end(), texel));
  for (std::size_t i = 0; i < set.source.texels.size(); i += 7)
    REQUIRE(std::binary_search(texels.begin(), texels.end(),
                               evaluate_warp(exact.compiled, set.source.texels[i])));
  const double of_blends = copy_rms_error(blended, set.source, set.target),
               of_copies = copy_rms_error(exact, set.source, set.target);
  CAPTURE(of_blends, of_copies);
  CHECK(of_blends < 0.02);
  CHECK(of_copies < 2.0 * of_blends);
}

TEST_CASE("warp: the error of the table equals that of individually measured positions", "[warp]") {
  const WarpSet set = small_leaf();
  const WarpFit fit = fit_warp(set.source, set.target, strokes_of(set, 0));
  const auto copy = copy_exactly(fit, set.source, set.target);
  double squares = 0.0;
  for (std::size_t i = 0; i < copy.size(); ++i) {
    const auto own =
        coordinates_of(fit.target_coordinates(), evaluate_warp(fit.compiled, set.source.texels[i]));
    const auto copied = coordinates_of(fit.target_coordinates(), set.target.texels[copy[i]]);
    for (std::size_t k = 0; k < 3; ++k) squares += std::pow(own[k] - copied[k], 2);
  }
  CHECK(copy_rms_error(fit, set.source, set.target) ==
        Approx(std::sqrt(squares / static_cast<double>(copy.size()))));
}

TEST_CASE("warp: texels that are not finite are skipped", "[warp]") {
  WarpSet set = small_leaf();
  const auto strokes = strokes_of(set, 0);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  set.source.texels[5][2] = nan;
  set.target.texels[9][6] = std::numeric_limits<float>::infinity();
  const WarpFit fit = fit_warp(set.source, set.target, strokes);
  CHECK(fit.diagnostics.source_left_out == 1);
  CHECK(fit.diagnostics.target_left_out == 1);
  CHECK_FALSE(warnings_of(fit.diagnostics).empty());
  CHECK(std::isnan(evaluate_warp(fit.compiled, set.source.texels[5])[0]));
}

TEST_CASE("warp: few strokes do not determine all directions, and some contradict each other", "[warp]") {
  const WarpSet set = small_leaf();
  const auto strokes = strokes_of(set, 0);
  const auto warned = [&](const std::vector<StrokePair>& some, std::size_t fixed, const std::string& words) {
    const WarpFit fit = fit_warp(set.source, set.target, some);
    CHECK(fit.diagnostics.fixed_directions == static_cast<int>(fixed));
    std::string all;
    for (const std::string& warning : warnings_of(fit.diagnostics)) all += warning + "\n";
    CHECK_THAT(all, Catch::Contains(words));
    return all;
  };
  warned({strokes[0]}, 0, "strokes do not determine direction 1 of 2");
  CHECK_THAT(warned({strokes[0], strokes[1]}, 1, "strokes do not determine direction 2 of 2"),
             !Catch::Contains("direction 1 of 2"));
  // The second stroke marks other texels of the first region. Its partner is the opposite corner of the
  // template.
  std::vector<StrokePair> twice = strokes_of(set, 0);
  twice.push_back({strokes_of(set, 1)[2].source, strokes_of(set, 1)[3].target});
  warned(twice, 2, "strokes contradict each other");
}

TEST_CASE("warp: invalid input is refused", "[warp]") {
  const WarpSet set = small_leaf();
  const auto strokes = strokes_of(set, 0);
  using Catch::Contains;
  CHECK_THAT(error_of([&] { fit_warp(set.source, set.target, {}); }),
             Contains("at least one pair of strokes"));
  CHECK_THAT(error_of([&] {
               fit_warp(set.source, set.target, {{{}, {1}}});
             }),
             Contains("stroke 1: the stroke marks no texel"));
  CHECK_THAT(error_of([&] { fit_warp(set.source, set.target, {{{1}, {99999}}}); }), Contains("texel 99999"));
  CHECK_THAT(error_of([&] {
               fit_warp(set.source, set.target, {{{1, 2}, {1}}, {{2}, {7}}});
             }),
             Contains("stroke 2: lies within stroke 1"));
  WarpMaterial black = set.source, plain = set.target, torn = set.source;
  for (auto& texel : torn.texels) texel.fill(std::numeric_limits<float>::quiet_NaN());
  CHECK_THAT(error_of([&] { fit_warp(torn, set.target, strokes); }),
             Contains("leaf source: contains no texel with finite values"));
  for (auto& texel : black.texels) texel = {0, 0, 0, 0, 0, 0, 0.3f};
  for (auto& texel : plain.texels) texel = plain.texels[0];
  CHECK_THAT(error_of([&] { fit_warp(black, set.target, strokes); }),
             Contains("leaf source: all texels look the same"));
  CHECK_THAT(error_of([&] { fit_warp(set.source, plain, strokes); }),
             Contains("leaf template: all texels look the same"));
}

TEST_CASE("warp fits: files preserve every bit, and damaged files are refused", "[warp]") {
  const WarpSet set = small_leaf();
  WarpMapFit fit;
  fit.id = "leaf";
  fit.source_model = fit.template_model = "mitsuba/ggx";
  fit.warp = fit_warp(set.source, set.target, strokes_of(set, 0)).compiled;
  fit.copy_rms_error = 0.0123;
  fit.method = {{"method", "registration"}};
  fit.remarks = {"A remark."};
  fit.tool_version = "0";
  for (const bool quadratic : {false, true})
    for (const bool copied : {false, true}) {
      fit.warp = random_warp({2, quadratic, copied}, 7, 128);
      const std::string text = fit_to_json(fit);
      const AnyFit read = any_fit_from_json(text, "x");
      REQUIRE(std::holds_alternative<WarpMapFit>(read));
      CHECK(std::get<WarpMapFit>(read) == fit);
      CHECK_THROWS_AS(fit_from_json(text, "x"), Error);
      const auto refused = [&](const std::string& found, const std::string& other,
                               const std::string& message) {
        std::string copy = text;
        copy.replace(copy.find(found), found.size(), other);
        CHECK_THROWS_WITH(any_fit_from_json(copy, "x"), Catch::Contains(message));
      };
      refused("\"nodes\": 128", "\"nodes\": 127", "the table has the wrong size");
      refused("\"nodes\": 128", "\"nodes\": 1", "the number of nodes is invalid (2 to 4096");
      refused("\"dimension\": 2", "\"dimension\": 3", "the weights of");
      refused("\"copy_rms_error\": 0.0123", "\"copy_rms_error\": -2", "-1 if it is unknown");
      if (copied) {
        refused("\"indices\": \"", "\"indices\": \"//8", "base64 in whole groups");
        refused("\"indices\": \"", "\"indices\": \"////", "integers of 2 bytes");
        refused("\"palette\": \"", "\"palette\": \"AAAA", "integers of 4 bytes");
        refused("\"kind\": \"copied\"", "\"kind\": \"other\"", "blended or copied");
        // These changes are hidden in base64.
        const auto invalid = [&](const auto& change, const std::string& message) {
          CompiledWarp warp = fit.warp;
          change(std::get<CopiedNodes>(warp.table.entries));
          CHECK_THROWS_WITH(require_valid(warp, "leaf"), Catch::Contains("leaf: " + message));
        };
        invalid(
            [](CopiedNodes& nodes) { nodes.indices[5] = static_cast<std::uint16_t>(nodes.palette.size()); },
            "an index is beyond the end of the palette");
        for (const float value : {std::numeric_limits<float>::quiet_NaN(), -0.5f})
          invalid([&](CopiedNodes& nodes) { nodes.palette[1][3] = value; },
                  "the palette contains an invalid value");
        invalid([](CopiedNodes& nodes) { nodes.palette.clear(); },
                "the palette has the wrong size (1 to 65536 texels)");
      } else {
        refused("\"codes\": \"", "\"codes\": \"A", "base64 in whole groups");
      }
    }
}
