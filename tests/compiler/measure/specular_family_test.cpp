// This file tests models without a known law of specular: the pictures whose combinations give all others,
// and matches with them, against direct renders.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <catch2/catch.hpp>

#include "compiler/measure/sweep_session.hpp"
#include "compiler/renderer/disguised_renderer.hpp"
#include "measure/match.hpp"
#include "measure/picture_taker.hpp"
#include "measure/probe.hpp"
#include "measure/specular_response.hpp"
#include "measure/sweep.hpp"
#include "measure/target_pictures.hpp"

using namespace remap;

namespace {

constexpr Range kAlphas{0.05, 0.8};

// Returns a renderer like three.js: a part proportional to level, a wider part proportional to its square,
// and light at level 0.
BlendRenderer quadratic_blend() {
  return BlendRenderer({{"mitsuba/ggx-plain", 1.0, [](double level) { return 0.01 + 0.6 * level; }},
                        {"mitsuba/beckmann-plain", 1.2, [](double level) { return 0.8 * level * level; }}},
                       {0.0, 1.0});
}

// Returns a renderer like Cycles and Mitsuba's Disney BSDFs: exact Fresnel by the index of an F0 of 0.08
// times the level.
LawRenderer fresnel_level() {
  return LawRenderer("mitsuba/ggx-dielectric", {0.0, 1.0}, [](double level) {
    const double root = std::sqrt(0.08 * level);
    return (1.0 + root) / (1.0 - root);
  });
}

std::optional<SpecularFamily> family_of(const Renderer& renderer, const std::string& model) {
  const PictureTaker picture_taker(renderer, objective_preset("natural"), 48, 1);
  return probe_family(picture_taker, renderer.model(model), kAlphas);
}

// Returns the largest deviation of the family's pictures from rendered ones, relative to the brightest pixel
// at full specular. It uses speculars and widths that were not probed.
double family_deviation(const Renderer& renderer, const std::string& model, const SpecularFamily& family) {
  const PictureTaker picture_taker(renderer, objective_preset("natural"), 48, 1);
  const ProbedModel probed_model{renderer.model(model), {}, 1.0, family};
  double worst = 0.0;
  for (const double alpha : {0.071, 0.33, 0.79}) {
    const auto pictures = take_family(picture_taker, probed_model, alpha);
    const auto full = picture_taker.take(probed_model, {alpha, family.range.max, 0.0});
    for (double share = 0.003; share < 1.0; share += 0.037) {
      const double specular = family.range.min + share * (family.range.max - family.range.min);
      const auto expected = combined(pictures, family.weights_at(specular));
      const auto found = picture_taker.take(probed_model, {alpha, specular, 0.0});
      for (std::size_t i = 0; i < found.size(); ++i)
        worst = std::max(worst, std::fabs(static_cast<double>(expected[i]) - found[i]) /
                                    static_cast<double>(*std::max_element(full.begin(), full.end())));
    }
  }
  return worst;
}

// A RenderedLoss is the weighted squared difference of a target's picture from a source's, by direct renders.
class RenderedLoss {
 public:
  RenderedLoss(const Renderer& renderer, const SweepOptions& options, const RoleValues& source)
      : picture_taker_(renderer, options.objective, options.resolution, 1),
        target_(renderer.model(options.target)),
        source_(picture_taker_.take(renderer.model(options.source), source)),
        weights_(picture_taker_.weights(source_).squared) {}

  double operator()(double alpha, double specular) const {
    const auto picture = picture_taker_.take(target_, {alpha, specular, 0.0});
    double sum = 0.0;
    for (std::size_t i = 0; i < picture.size(); ++i)
      sum += weights_[i] * std::pow(static_cast<double>(picture[i]) - source_[i], 2);
    return sum;
  }

  // Returns the best point of a grid over both ranges, refined by ever smaller grids around it.
  RoleValues brute_force(const Range& alphas, const Range& speculars) const {
    RoleValues best{std::sqrt(alphas.min * alphas.max), 0.5 * (speculars.min + speculars.max), 0.0};
    double width = 0.5 * std::log(alphas.max / alphas.min), height = 0.5 * (speculars.max - speculars.min);
    double least = (*this)(best.alpha, best.specular);
    for (int count = 24; width > 1e-4; count = 8, width *= 0.3, height *= 0.3) {
      const RoleValues middle = best;
      for (int i = -count; i <= count; ++i)
        for (int j = -count; j <= count; ++j) {
          const double alpha = std::clamp(middle.alpha * std::exp(width * i / count), alphas.min, alphas.max);
          const double specular =
              std::clamp(middle.specular + height * j / count, speculars.min, speculars.max);
          const double found = (*this)(alpha, specular);
          if (!(found < least)) continue;
          least = found;
          best = {alpha, specular, 0.0};
        }
    }
    return best;
  }

 private:
  PictureTaker picture_taker_;
  ModelDescription target_;
  std::vector<float> source_, weights_;
};

}  // namespace

TEST_CASE("polynomial: minima over a range agree with a dense grid") {
  // The polynomial has degree 6 and two minima of different depth. The ranges contain both, one, or only an
  // end.
  const std::vector<double> wells = {0.2, -0.35, -2.1, 0.3, 2.4, 0.05, 0.1};
  for (const Range range : {Range{-1.0, 1.0}, {-0.2, 1.0}, {-1.0, -0.9}, {0.0, 0.3}}) {
    std::vector<double> grid;
    constexpr int kSteps = 200000;
    for (int i = 0; i <= kSteps; ++i)
      grid.push_back(polynomial_value(wells, range.min + (range.max - range.min) * i / kSteps));
    std::vector<double> expected;
    for (std::size_t i = 0; i < grid.size(); ++i)
      if ((i == 0 || grid[i] <= grid[i - 1]) && (i + 1 == grid.size() || grid[i] <= grid[i + 1]))
        expected.push_back(grid[i]);
    std::sort(expected.begin(), expected.end());
    const auto found = polynomial_minima(wells, range);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      CHECK(polynomial_value(wells, found[i]) == Approx(expected[i]).margin(1e-9));
  }
}

TEST_CASE("polynomial: a parabola has its minimum at the vertex or the nearer end, a line at its lower end") {
  const std::vector<double> parabola = {1.0, -2.0, 2.0};
  CHECK(polynomial_minima(parabola, {0.0, 1.0}).front() == 0.5);
  CHECK(polynomial_minima(parabola, {0.0, 0.25}).front() == 0.25);
  CHECK(polynomial_minima({1.0, -3.0}, {0.0, 2.0}).front() == 2.0);
  CHECK(polynomial_minima({1.0, 3.0, 0.0}, {0.5, 2.0}).front() == 0.5);
  CHECK(polynomial_minima({0.0, 0.0, -1.0}, {-1.0, 2.0}).front() == 2.0);
}

TEST_CASE("family: a few pictures give all others of a model without a law", "[slow]") {
  // Two pictures are needed, whatever the law of their weights. One is enough if only the strength changes.
  const BlendRenderer blend = quadratic_blend();
  const auto quadratic = family_of(blend, "disguised/blend");
  REQUIRE(quadratic);
  CHECK(quadratic->coordinate_kind == SpecularCoordinate::kEven);
  CHECK(quadratic->picture_count() == 2);
  CHECK(family_deviation(blend, "disguised/blend", *quadratic) < 2e-6);

  const LawRenderer scaled("mitsuba/ward", {0.0, 1.0}, [](double s) { return 0.3 * s + 0.7 * s * s; });
  const auto strength = family_of(scaled, "disguised/law");
  REQUIRE(strength);
  CHECK(strength->picture_count() == 1);
  CHECK(family_deviation(scaled, "disguised/law", *strength) < 2e-6);

  const LawRenderer fresnel = fresnel_level();
  const auto exact = family_of(fresnel, "disguised/law");
  REQUIRE(exact);
  CHECK(exact->coordinate_kind == SpecularCoordinate::kRoot);
  CHECK(exact->picture_count() <= 5);
  CHECK(family_deviation(fresnel, "disguised/law", *exact) <
        4e-6);  // twice the tolerance of the points that the probe compares
}

TEST_CASE("family: a law that bends sharply has no family") {
  const LawRenderer stairs("mitsuba/ward", {0.0, 1.0},
                           [](double level) { return level < 0.4 ? level : std::max(0.4, level - 0.3); });
  CHECK_FALSE(family_of(stairs, "disguised/law"));
}

TEST_CASE("sweep: a target that is quadratic in specular is matched as direct renders show it, everywhere",
          "[slow]") {
  const BlendRenderer renderer = quadratic_blend();
  const std::vector<MappedTexel> samples = {{0.12, 0.3}, {0.3, 0.05}, {0.3, 0.6}, {0.5, 0.9}};
  for (const std::string objective : {"natural-1", "natural-2", "paper"}) {
    const SweepOptions options = sweep_options("mitsuba/ward", "disguised/blend", objective, samples, 32);
    const Table table = sweep(renderer, options);
    CHECK(comment(table, "target_specular_law") == "other");
    CHECK(comment(table, "target_specular_interpolated") == "2 pictures a width");
    for (const TableRow& row : table.rows) {
      INFO(objective << ": alpha " << row.alpha1 << " specular " << row.specular1);
      const RenderedLoss loss(renderer, options, {row.alpha1, row.specular1, 0.0});
      const RoleValues best = loss.brute_force(kAlphas, {0.0, 1.0});
      // The grid ends at steps of about 1e-5. Float pictures cause an error of 1e-7 in the loss, whose root
      // matters here.
      CHECK(row.alpha2 == Approx(best.alpha).epsilon(1e-3));
      CHECK(row.specular2 == Approx(best.specular).epsilon(1e-3));
      CHECK(loss(row.alpha2, row.specular2) <= loss(best.alpha, best.specular) * (1.0 + 1e-6));
    }
  }
}

TEST_CASE("sweep: the family finds what the search by renders finds, with a fraction of the pictures") {
  const BlendRenderer renderer = quadratic_blend();
  const SweepOptions options = sweep_options("mitsuba/ward", "disguised/blend", "natural-1",
                                             grid_samples({0.1, 0.6}, 3, {0.0, 0.8}, 6), 48);
  const Table table = sweep(renderer, options);
  // The pictures are probes of the law and of the family, two at each of at most 66 nodes, and one for each
  // compared sphere.
  CHECK(renderer.pictures() <= 10 + 27 + 2 * 67 + 3);
  const std::size_t before = renderer.pictures();
  const PictureTaker picture_taker(renderer, options.objective, options.resolution, 1);
  const ModelDescription target = renderer.model("disguised/blend");
  const RenderedPictures pictures(picture_taker, {target, {}}, kAlphas);
  for (const TableRow& row : table.rows) {
    auto source = picture_taker.take(renderer.model("mitsuba/ward"), {row.alpha1, row.specular1, 0.0});
    auto weights = picture_taker.weights(source);
    const JointMatcher matcher(pictures, {{std::move(source), std::move(weights)}}, DiffuseSearch::kNone);
    const Match match = matcher.match({{row.alpha1, 0.5, 0.0}});
    // The margin allows for central differences of float pictures and for the tolerances of Ceres.
    CHECK(row.alpha2 == Approx(match.point().alpha).epsilon(1e-4));
    CHECK(row.specular2 == Approx(match.point().specular).epsilon(2e-4));
    CHECK(row.error == Approx(match.error).epsilon(1e-5));
  }
  CHECK(renderer.pictures() - before > 2 * before);
}

TEST_CASE("sweep: exact Fresnel of a specular level is matched with itself") {
  const LawRenderer renderer = fresnel_level();
  const Table table = sweep(renderer, sweep_options("disguised/law", "disguised/law", "natural",
                                                    grid_samples({0.08, 0.7}, 3, {0.0, 0.95}, 8), 48));
  for (const TableRow& row : table.rows) {
    INFO("alpha " << row.alpha1 << " specular " << row.specular1);
    // A picture may be a tenth as bright as at full specular. There, an error of 2e-6 becomes 2e-5.
    CHECK(row.alpha2 == Approx(row.alpha1).epsilon(1e-4));
    CHECK(row.specular2 == Approx(row.specular1).epsilon(1e-4));
    CHECK(row.status == RowStatus::kOk);
  }
}

TEST_CASE("sweep: two speculars that give the same picture make a row unstable") {
  // Both 0.3 and 0.8 give 0.48. Only one value gives 0.15.
  const LawRenderer renderer("mitsuba/ward", {0.0, 1.0}, [](double s) { return s * (2.2 - 2.0 * s); });
  const Table table = sweep(
      renderer, sweep_options("mitsuba/ward", "disguised/law", "natural", {{0.3, 0.48}, {0.3, 0.15}}, 48));
  CHECK(table.rows[0].status == RowStatus::kUnstable);
  CHECK(table.rows[0].alpha2 == Approx(0.3).epsilon(1e-5));
  CHECK(table.rows[1].status == RowStatus::kOk);
  CHECK(table.rows[1].specular2 == Approx((2.2 - std::sqrt(4.84 - 1.2)) / 4.0).epsilon(1e-5));
}

TEST_CASE("sweep: a source without a law is flat where it is black, whatever its parameter is there") {
  const LawRenderer renderer("mitsuba/ward", {1.0, 2.0}, [](double s) { return 0.9 * std::pow(s - 1.0, 2); });
  const Table table = sweep(renderer, sweep_options("disguised/law", "mitsuba/ward", "natural",
                                                    {{0.3, 1.0}, {0.3, 1.2}, {0.3, 1.6}, {0.3, 2.0}}, 48));
  CHECK(comment(table, "source_specular_interpolated") == "1 picture a width");
  CHECK(table.rows[0].status == RowStatus::kFlat);
  for (std::size_t i = 1; i < table.rows.size(); ++i)
    CHECK(table.rows[i].specular2 == Approx(0.9 * std::pow(table.rows[i].specular1 - 1.0, 2)).epsilon(1e-5));
}

TEST_CASE("pictures: those of a family and their derivatives agree with renders") {
  const LawRenderer renderer = fresnel_level();
  const PictureTaker picture_taker(renderer, objective_preset("natural"), 32, 1);
  const ModelDescription model = renderer.model("disguised/law");
  const ProbedModel target{model, probe_specular(picture_taker, model, kAlphas), 1.0,
                           probe_family(picture_taker, model, kAlphas)};
  REQUIRE(target.family());
  const TargetBank bank(picture_taker, target, kAlphas, kBankRatio);
  const BankPictures interpolated(picture_taker, target, bank);
  const RenderedPictures rendered(picture_taker, target, kAlphas);
  const std::vector<bool> wanted(3, true);
  const std::vector<RoleValues> points = {
      {0.2, 0.3, 0.1}, {0.2, 0.6, 0.4}, {0.7, 0.9, 0.0}, {0.11, 0.02, 0.5}};
  const std::vector<PictureTangents> of_bank = interpolated.at(points, wanted),
                                     of_renders = rendered.at(points, wanted);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const PictureTangents &a = of_bank.at(p), &b = of_renders.at(p);
    const auto close = [](const std::vector<float>& found, const std::vector<float>& expected) {
      double worst = 0.0, largest = 0.0;
      for (std::size_t i = 0; i < found.size(); ++i) {
        worst = std::max(worst, std::fabs(static_cast<double>(found[i]) - expected[i]));
        largest = std::max(largest, std::fabs(static_cast<double>(expected[i])));
      }
      return worst / largest;
    };
    CHECK(close(a.picture, b.picture) < 1e-5);
    // The difference quotients have steps of 1e-3 of the range, and pictures are floats. Second-order errors
    // are visible at small specular.
    for (std::size_t c = 0; c < 3; ++c) CHECK(close(a.by[c], b.by[c]) < 1e-3);
  }
}

TEST_CASE("material sample: a target without a law is matched by the bank's pictures") {
  const BlendRenderer renderer = quadratic_blend();
  MaterialSampleOptions options;
  options.source = options.target = "disguised/blend";
  options.objective = objective_preset("natural-1");
  options.resolution = 32;
  options.count = 12;
  options.seed = 3;
  options.ranges = {{"alpha", {0.2, 0.7}}, {"level", {0.1, 0.9}}};
  const MaterialTable table = run_material_sample(renderer, options, {});
  for (const NamedRow& row : table.rows) {
    CHECK(row.status == RowStatus::kOk);
    for (std::size_t i = 0; i < row.source.size(); ++i)
      CHECK(row.target[i] == Approx(row.source[i]).epsilon(2e-4));
  }
  // The pictures are one per sample, probes of the law (10) and of the family, and two at each of 67 nodes. A
  // search that renders each step would need a hundred pictures per sample.
  CHECK(renderer.pictures() <= 12 + 10 + 27 + 2 * 67);
}
