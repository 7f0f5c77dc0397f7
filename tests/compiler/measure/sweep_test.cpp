// This file tests the sweep against the published table, against figures of an independent program, and
// against pictures rendered at its results: the lights and weights of an objective, and diffuse and
// specular together in one, two and three stages (section 3.1 of the paper).
#include "measure/sweep.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <numeric>

#include <catch2/catch.hpp>

#include "compiler/measure/sweep_session.hpp"
#include "core/files.hpp"
#include "measure/match.hpp"
#include "measure/objective.hpp"
#include "measure/picture_taker.hpp"
#include "measure/target_pictures.hpp"
#include "remap/error.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"

using namespace remap;

TEST_CASE("sweep: objective paper reproduces the published table at its samples", "[slow]") {
  const auto path = shared_data("tables/mitsuba-ward2mitsuba-as.csv");
  if (path.empty()) return;
  const Table published = read_table(path, column_map("sztrajman-2019"));
  REQUIRE(published.rows.size() == 721);
  std::vector<MappedTexel> samples;
  for (const TableRow& row : published.rows) samples.push_back({row.alpha1, row.specular1});
  const Table own = sweep(builtin_renderer(), sweep_options("mitsuba/ward", "mitsuba/as", "paper", samples));

  double alpha_error = 0.0, specular_error = 0.0, subpixel_alpha_error = 0.0, subpixel_specular_error = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double alpha = std::fabs(own.rows[i].alpha2 - published.rows[i].alpha2);
    const double specular = std::fabs(own.rows[i].specular2 / published.rows[i].specular2 - 1.0);
    const bool resolved = samples[i].alpha >= 0.03;
    double& worst_alpha = resolved ? alpha_error : subpixel_alpha_error;
    double& worst_specular = resolved ? specular_error : subpixel_specular_error;
    worst_alpha = std::max(worst_alpha, alpha);
    worst_specular = std::max(worst_specular, specular);
  }
  std::cout << "published table: alpha within " << alpha_error << ", specular within " << 100 * specular_error
            << " %; below alpha 0.03 (highlight under a pixel) " << subpixel_alpha_error << " and "
            << 100 * subpixel_specular_error << " %\n";
  CHECK(alpha_error <= 6e-4);
  CHECK(specular_error <= 2e-3);
}

TEST_CASE("sweep: Beckmann to GGX and Ward to GGX give the figures measured elsewhere", "[slow]") {
  // An independent prototype measured natural-1 .1221 and 1.032, paper .157 and 1.265, and Ward without
  // Fresnel .1188 and .712. Tolerances are a little more than half a unit of the last digit.
  const auto row = [&](const std::string& source, const std::string& target, const std::string& objective) {
    return sweep(builtin_renderer(), sweep_options(source, target, objective, {{0.15, 0.5}})).rows.front();
  };
  const TableRow natural = row("mitsuba/beckmann", "mitsuba/ggx", "natural-1");
  CHECK(natural.alpha2 == Approx(0.1221).margin(6e-5));
  CHECK(natural.specular2 / 0.5 == Approx(1.032).margin(6e-4));
  const TableRow paper = row("mitsuba/beckmann", "mitsuba/ggx", "paper");
  CHECK(paper.alpha2 == Approx(0.157).margin(6e-4));
  CHECK(paper.specular2 / 0.5 == Approx(1.265).margin(6e-4));
  const TableRow ward = row("mitsuba/ward", "mitsuba/ggx-plain", "natural-1");
  CHECK(ward.alpha2 == Approx(0.1188).margin(6e-5));
  CHECK(ward.specular2 / 0.5 == Approx(0.712).margin(6e-4));
}

TEST_CASE("sweep: a model matched with itself is the identity") {
  for (const std::string model : {"mitsuba/ward", "mitsuba/ggx", "mitsuba/phong"}) {
    for (const std::string objective : {"natural-1", "natural-2", "paper"}) {
      const auto samples = grid_samples({0.05, 0.9}, 4, {0.0, 0.9}, 3);
      for (const TableRow& row :
           sweep(builtin_renderer(), sweep_options(model, model, objective, samples, 128)).rows) {
        CHECK(row.alpha2 == Approx(row.alpha1).epsilon(1e-6));
        CHECK(row.specular2 == Approx(row.specular1).epsilon(1e-6));
        // The loss should be 0. The error is the square root of the small loss that interpolation causes.
        CHECK(row.error < 5e-4);
        CHECK(row.status == RowStatus::kOk);
      }
    }
  }
}

TEST_CASE("sweep: the result is the minimum of the loss of direct renders") {
  const SweepOptions options =
      sweep_options("mitsuba/ggx", "mitsuba/beckmann", "natural", {{0.31, 0.37}}, 128);
  const TableRow row = sweep(builtin_renderer(), options).rows.front();

  const PictureTaker picture_taker(builtin_renderer(), options.objective, options.resolution, 1);
  const auto source = picture_taker.take(builtin_renderer().model("mitsuba/ggx"), {0.31, 0.37, 0.0});
  const auto weights = picture_taker.weights(source).squared;
  const auto loss = [&](double alpha, double specular) {
    const auto target =
        picture_taker.take(builtin_renderer().model("mitsuba/beckmann"), {alpha, specular, 0.0});
    double sum = 0.0;
    for (std::size_t i = 0; i < source.size(); ++i)
      sum += weights[i] * std::pow(static_cast<double>(source[i]) - target[i], 2);
    return sum;
  };
  // Returns the vertex of the parabola through three renders. Its error is the change of the curvature times
  // the square of the step, which is 1e-3. Float pictures cause an error of 1e-7 in the loss.
  const auto vertex = [](double low, double middle, double high, double step) {
    return step * (low - high) / (2.0 * (low - 2.0 * middle + high));
  };
  const double step = 1e-3, middle = loss(row.alpha2, row.specular2);
  CHECK(std::fabs(vertex(loss(row.alpha2 - step, row.specular2), middle,
                         loss(row.alpha2 + step, row.specular2), step)) < 2e-5);
  CHECK(std::fabs(vertex(loss(row.alpha2, row.specular2 - step), middle,
                         loss(row.alpha2, row.specular2 + step), step)) < 2e-5);
}

TEST_CASE("sweep: the table has the same bytes for any number of threads") {
  const SweepOptions options =
      sweep_options("mitsuba/ggx", "mitsuba/as", "natural", grid_samples({0.02, 1.0}, 7, {0.0, 1.0}, 4), 96);
  const std::string one = table_text(sweep(builtin_renderer(), options, 1));
  CHECK(table_text(sweep(builtin_renderer(), options, 2)) == one);
  CHECK(table_text(sweep(builtin_renderer(), options, 5)) == one);
}

TEST_CASE("sweep: ends soon after it is cancelled") {
  const SweepOptions options =
      sweep_options("mitsuba/ward", "mitsuba/as", "natural", grid_samples({0.05, 1.0}, 6, {0.0, 1.0}, 3), 64);
  std::atomic<bool> cancelled{false};
  SweepExecution execution;
  execution.jobs = 1;
  execution.cancelled = &cancelled;
  std::size_t rows = 0;
  execution.progress = [&](std::size_t done, std::size_t) {
    rows = done;
    cancelled = done >= 9;
  };
  CHECK_THROWS_WITH(run_sweep(builtin_renderer(), options, execution), "sweep: interrupted");
  CHECK(rows == 9);
}

TEST_CASE("sweep: rows on both sides mark where the target reaches a limit, and comments tell the limits") {
  std::vector<MappedTexel> samples;
  for (int j = 1; j <= 6; ++j) samples.push_back({0.65, j / 6.0});
  const Table table =
      sweep(builtin_renderer(), sweep_options("mitsuba/as", "mitsuba/ward", "natural", samples, 64));
  CHECK(table.limits.alpha == 1.0);
  CHECK(table.limits.specular == 1.0);
  // The samples keep their order, and the rows that were added follow them.
  for (std::size_t j = 0; j < samples.size(); ++j) CHECK(table.rows[j].specular1 == samples[j].specular);
  std::vector<TableRow> rows = table.rows;
  std::ranges::sort(rows, {}, &TableRow::specular1);
  std::vector<RowStatus> passed;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    REQUIRE(has_answer(rows[i]));
    if (!passed.empty() && passed.back() == rows[i].status) continue;
    passed.push_back(rows[i].status);
    if (i != 0) CHECK(rows[i].specular1 - rows[i - 1].specular1 < 1.0 / 6.0 / 60.0);
  }
  CHECK(passed == std::vector{RowStatus::kWide, RowStatus::kCorner, RowStatus::kBright});
}

TEST_CASE("sweep: a sample without specular is flat, one beyond the target's bound is clamped") {
  const Table table = sweep(builtin_renderer(), sweep_options("mitsuba/beckmann", "mitsuba/ggx", "paper",
                                                              {{0.5, 0.0}, {0.5, 0.4}, {0.5, 1.0}}, 64));
  CHECK(table.rows[0].status == RowStatus::kFlat);
  CHECK(table.rows[0].specular2 == 0.0);
  CHECK(table.rows[1].status == RowStatus::kOk);
  CHECK(table.rows[2].status == RowStatus::kBright);
  CHECK(table.rows[2].specular2 == 1.0);
}

TEST_CASE("sweep: several lights are matched together") {
  SweepOptions options = sweep_options("mitsuba/beckmann", "mitsuba/ggx", "paper", {{0.3, 0.4}}, 96);
  const double headlight = sweep(builtin_renderer(), options).rows.front().alpha2;
  options.objective.lights = {Light{70.0}};
  const double side = sweep(builtin_renderer(), options).rows.front().alpha2;
  options.objective.lights = {Light{}, Light{70.0}};
  const double both = sweep(builtin_renderer(), options).rows.front().alpha2;
  CHECK(both > std::min(headlight, side));
  CHECK(both < std::max(headlight, side));
}

TEST_CASE("bank: widths cover the range, within the model's, no further apart than the ratio") {
  const PictureTaker picture_taker(builtin_renderer(), objective_preset("paper"), 8, 1);
  const ModelDescription model = builtin_renderer().model("mitsuba/ggx");
  const SpecularResponse response = probe_specular(picture_taker, model, {0.1, 1.0});
  // The last range is smaller than a window of full steps.
  for (const Range alphas :
       {Range{0.00275625, 1.0}, {0.01, 0.99}, {0.2, 0.2 * 1.6}, {0.25, 1.0}, {0.95, 1.0}})
    for (const bool takes_less : {false, true}) {
      ProbedModel target{model, response};
      target.model.alpha.min = takes_less ? 1e-4 : alphas.min;
      const TargetBank bank(picture_taker, target, alphas, kBankRatio);
      REQUIRE(bank.size() >= kInterpolationNodes);
      CHECK(bank.alpha(0) <= alphas.min);
      CHECK(bank.alpha(0) >= target.model.alpha.min);
      CHECK(bank.alpha(bank.size() - 1) == alphas.max);
      for (std::size_t i = 1; i < bank.size(); ++i) {
        CHECK(bank.alpha(i) > bank.alpha(i - 1));
        CHECK(bank.alpha(i) < bank.alpha(i - 1) * std::pow(kBankRatio, i == 1 ? 1.5001 : 1.0001));
      }
    }
}

TEST_CASE("grid: uniform over widths with both ends, over specular without 0") {
  const auto samples = grid_samples({0.1, 0.5}, 3, {0.0, 1.0}, 2);
  REQUIRE(samples.size() == 6);
  CHECK(samples[0].alpha == 0.1);
  CHECK(samples[2].alpha == Approx(0.3));
  CHECK(samples[5].alpha == 0.5);
  CHECK(samples[0].specular == 0.5);
  CHECK(samples[1].specular == 1.0);
  CHECK(grid_samples({0.1, 0.5}, 1, {0.2, 1.0}, 2)[0].specular == 0.2);
}

namespace {

SweepOptions staged(int stages, std::vector<MappedTexel> samples, double diffuse = 0.3) {
  SweepOptions options = sweep_options("mitsuba/as", "mitsuba/ward", "paper", std::move(samples), 96);
  options.objective.lights = {{45.0, 3.0}};
  options.stages = stages;
  options.diffuse = diffuse;
  return options;
}

}  // namespace

TEST_CASE("stages: a model matched with itself keeps width, specular and diffuse") {
  for (const int stages : {1, 2, 3})
    for (const std::string model : {"mitsuba/ward", "mitsuba/ggx", "mitsuba/phong"}) {
      SweepOptions options = staged(stages, {{0.15, 0.3}, {0.3, 0.6}});
      options.source = options.target = model;
      for (const TableRow& row : sweep(builtin_renderer(), options).rows) {
        CHECK(row.alpha2 == Approx(row.alpha1).epsilon(1e-4));
        CHECK(row.specular2 == Approx(row.specular1).epsilon(1e-4));
        CHECK(row.diffuse2 == Approx(0.3).epsilon(1e-4));
        CHECK(row.error < 1e-4);
        CHECK(row.status == RowStatus::kOk);
      }
    }
}

TEST_CASE(
    "stages: three stages are never worse than two in the whole picture, and keep their start's basin") {
  const auto samples = grid_samples({0.1, 0.5}, 3, {0.0, 0.4}, 3);
  const Table two = sweep(builtin_renderer(), staged(2, samples)),
              three = sweep(builtin_renderer(), staged(3, samples));
  const Table one = sweep(builtin_renderer(), staged(1, samples));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    CHECK(three.rows[i].error <= two.rows[i].error * (1.0 + 1e-6));
    CHECK(two.rows[i].diffuse2 == 0.3);
    // If both results are ok, they are the same minimum.
    if (one.rows[i].status == RowStatus::kOk && three.rows[i].status == RowStatus::kOk) {
      CHECK(one.rows[i].alpha2 == Approx(three.rows[i].alpha2).epsilon(1e-3));
      CHECK(one.rows[i].specular2 == Approx(three.rows[i].specular2).epsilon(1e-3));
    }
  }
}

TEST_CASE("stages: width and specular of two stages do not depend on diffuse") {
  const std::vector<MappedTexel> samples = {{0.2, 0.3}, {0.4, 0.5}};
  const Table with = sweep(builtin_renderer(), staged(2, samples)),
              without = sweep(builtin_renderer(), staged(2, samples, 0.0));
  CHECK_FALSE(without.has_diffuse);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    CHECK(with.rows[i].alpha2 == without.rows[i].alpha2);
    CHECK(with.rows[i].specular2 == without.rows[i].specular2);
    // the error covers the whole picture, and diffuse is equal in both
    CHECK(with.rows[i].error < without.rows[i].error);
  }
}

TEST_CASE("stages: the joint match is a minimum of the whole picture as direct renders show it") {
  const SweepOptions options = staged(3, {{0.3, 0.3}});
  const TableRow row = sweep(builtin_renderer(), options).rows.front();
  const PictureTaker picture_taker(builtin_renderer(), options.objective, options.resolution, 1);
  const auto source = picture_taker.take(builtin_renderer().model("mitsuba/as"), RoleValues{0.3, 0.3, 0.3});
  const auto loss = [&](double alpha, double specular, double diffuse) {
    const auto target =
        picture_taker.take(builtin_renderer().model("mitsuba/ward"), RoleValues{alpha, specular, diffuse});
    double sum = 0.0;
    for (std::size_t i = 0; i < source.size(); ++i)
      sum += std::pow(static_cast<double>(source[i]) - target[i], 2);
    return sum;
  };
  const double step = 1e-3, middle = loss(row.alpha2, row.specular2, row.diffuse2);
  const auto vertex = [&](double da, double ds, double dd) {  // vertex of the parabola along one parameter
    const double low = loss(row.alpha2 - da, row.specular2 - ds, row.diffuse2 - dd);
    const double high = loss(row.alpha2 + da, row.specular2 + ds, row.diffuse2 + dd);
    return step * (low - high) / (2.0 * (low - 2.0 * middle + high));
  };
  CHECK(std::fabs(vertex(step, 0.0, 0.0)) < 1e-4);
  CHECK(std::fabs(vertex(0.0, step, 0.0)) < 1e-4);
  CHECK(std::fabs(vertex(0.0, 0.0, step)) < 1e-4);
}

TEST_CASE("stages: a joint match at a bound is clamped or unstable, and records its initial guess") {
  const Table table = sweep(builtin_renderer(), staged(1, {{0.6, 0.9}}));
  CHECK(table.rows.front().specular2 == Approx(1.0));
  CHECK(table.rows.front().status != RowStatus::kOk);
  CHECK(comment(table, "stages") == "1");
  CHECK(comment(table, "initial_guess") == "0.5,0.5,0.5 of the ranges of alpha, specular, diffuse");
}

TEST_CASE("stages: a target whose diffuse does not add is detected and matched by renders") {
  // A Layered renders a diffuse lobe that the highlight darkens, as layered models do.
  class Layered final : public Renderer {
   public:
    std::string version() const override { return "layered 1"; }
    std::vector<ModelDescription> models() const override { return inner_->models(); }
    Image render(const Material& material, const Scene& scene) const override {
      Material changed = material;
      if (material.model == "mitsuba/ward")
        changed.parameters.at("specular")[0] *= 1.0 - 0.5 * material.parameters.at("diffuse")[0];
      return inner_->render(changed, scene);
    }
    std::unique_ptr<Renderer> inner_ = make_builtin_renderer();
  };
  const Layered renderer;
  SweepOptions options = staged(1, {{0.25, 0.5}}, 0.4);
  options.source = options.target = "mitsuba/ward";
  const PictureTaker picture_taker(renderer, options.objective, 64, 1);
  CHECK_FALSE(probe_diffuse(picture_taker, renderer.model("mitsuba/ward"), {0.1, 1.0}));
  CHECK(probe_diffuse(picture_taker, renderer.model("mitsuba/ggx"), {0.1, 1.0}));
  const TableRow row = sweep(renderer, options).rows.front();
  CHECK(row.alpha2 == Approx(0.25).epsilon(1e-3));
  CHECK(row.specular2 == Approx(0.5).epsilon(1e-3));
  CHECK(row.diffuse2 == Approx(0.4).epsilon(1e-3));
}

TEST_CASE("stages: a black source is flat") {
  // specular is an index, and 1 means no boundary at all
  SweepOptions options = staged(1, {{0.3, 1.0}, {0.3, 1.5}}, 0.0);
  options.source = "mitsuba/as-dielectric";
  const Table table = sweep(builtin_renderer(), options);
  CHECK(table.rows[0].status == RowStatus::kFlat);
  CHECK(table.rows[0].specular2 == 0.0);
  CHECK(table.rows[1].specular2 > 0.01);
}

TEST_CASE(
    "stages: tables with diffuse are the same for any number of threads, and options out of range are "
    "refused") {
  const SweepOptions options = staged(3, grid_samples({0.2, 0.5}, 3, {0.0, 0.5}, 2));
  CHECK(table_text(sweep(builtin_renderer(), options, 1)) ==
        table_text(sweep(builtin_renderer(), options, 2)));
  CHECK_THROWS_WITH(sweep(builtin_renderer(), staged(4, {{0.3, 0.3}})),
                    Catch::Contains("stages: 4 is out of range"));
  CHECK_THROWS_WITH(sweep(builtin_renderer(), staged(2, {{0.3, 0.3}}, 1.5)),
                    Catch::Contains("diffuse 1.5 is out of range"));
}

namespace {

// A NaturalLoss is the loss of `natural-2`, computed from whole pictures by its definition.
class NaturalLoss {
 public:
  NaturalLoss(const Renderer& renderer, const Material& source, int side)
      : renderer_(renderer), side_(side), source_(picture_of(source)) {
    const std::vector<float> cosines = view_cosines(side, 1);
    const double brightest = *std::ranges::max_element(source_);
    for (std::size_t i = 0; i < source_.size(); ++i)
      weights_.push_back(std::pow(static_cast<double>(cosines[i]) / (source_[i] / brightest + 0.1), 2));
  }

  // Returns the loss relative to the power of the pixels.
  double operator()(const Material& target) const { return of(picture_of(target), 5.0); }
  double of_pixels(const Material& target) const { return of(picture_of(target), 0.0); }

 private:
  double of(const std::vector<double>& found, double mean_share) const {
    double difference = 0.0, power = 0.0;
    for (std::size_t i = 0; i < source_.size(); ++i) {
      difference += weights_[i] * std::pow(found[i] - source_[i], 2);
      power += weights_[i] * source_[i] * source_[i];
    }
    const auto sum = [](const std::vector<double>& picture) {
      return std::accumulate(picture.begin(), picture.end(), 0.0);
    };
    return difference / power + mean_share * std::pow(sum(found) / sum(source_) - 1.0, 2);
  }

  std::vector<double> picture_of(const Material& material) const {
    const Image image = renderer_.render(material, Scene{side_, 1, {65.0, 3.0}});
    return {image.values.begin(), image.values.end()};
  }

  const Renderer& renderer_;
  int side_;
  std::vector<double> source_, weights_;
};

}  // namespace

TEST_CASE("objective: natural weighs each pixel by cos_view / (I / max(I) + 0.1), squared") {
  const Objective natural = objective_preset("natural-1");
  REQUIRE(natural.lights == std::vector<Light>{{60.0, 3.0}});
  const std::vector<float> source = {0.0f, 1.0f, 4.0f}, cosines = {1.0f, 0.5f, 0.8f};
  const auto weights = squared_weights(natural, source, cosines).squared;
  CHECK(weights[0] == Approx(100.0));
  CHECK(weights[1] == Approx(0.5 / 0.35 * 0.5 / 0.35));
  CHECK(weights[2] == Approx(0.8 / 1.1 * 0.8 / 1.1));
}

TEST_CASE("objective: natural uses the brightest pixel of each light separately") {
  Objective objective = objective_preset("natural-1");
  objective.lights = {Light{}, Light{60.0}};
  const std::vector<float> source = {1.0f, 2.0f, 10.0f, 20.0f}, cosines = {1.0f, 1.0f};
  const auto weights = squared_weights(objective, source, cosines).squared;
  CHECK(weights[0] == weights[2]);
  CHECK(weights[1] == weights[3]);
}

TEST_CASE("objective: a mean that is off by all of itself costs its share of the power of the pixels") {
  Objective objective = objective_preset("natural-2");
  objective.lights = {Light{}, Light{60.0}};
  const std::vector<float> source = {1.0f, 2.0f, 0.3f, 10.0f, 20.0f, 3.0f}, cosines = {1.0f, 0.5f};
  const auto [weights, means] = squared_weights(objective, source, cosines);
  CHECK(means == std::vector<std::size_t>{2, 5});
  for (const std::size_t i : {0u, 3u}) {
    const double power = weights[i] * source[i] * source[i] + weights[i + 1] * source[i + 1] * source[i + 1];
    CHECK(weights[i + 2] * source[i + 2] * source[i + 2] == Approx(5.0 * power));
  }
}

TEST_CASE("objective: a black picture leaves finite weights") {
  const std::vector<float> source(3, 0.0f), cosines = {1.0f, 0.5f};
  for (const float weight : squared_weights(objective_preset("natural-2"), source, cosines).squared)
    CHECK(std::isfinite(weight));
}

TEST_CASE("objective: natural is its newest version, and a sweep finds the minimum of its loss") {
  CHECK(objective_preset("natural") == objective_preset("natural-2"));
  constexpr int kSide = 64;
  using Pair = std::pair<std::string, std::string>;
  for (const Pair& pair : {Pair{"mitsuba/ggx", "mitsuba/beckmann"}, Pair{"mitsuba/ward", "mitsuba/ggx"}}) {
    const auto& source = pair.first;
    const auto& target = pair.second;
    INFO(source);
    const TableRow row =
        sweep(builtin_renderer(), sweep_options(source, target, "natural-2", {{0.31, 0.37}}, kSide))
            .rows.front();
    const NaturalLoss loss(builtin_renderer(),
                           grey_material(builtin_renderer().model(source), 0.31, 0.37, 0.0), kSide);
    const auto at = [&](double alpha, double specular) {
      return loss(grey_material(builtin_renderer().model(target), alpha, specular, 0.0));
    };
    const double least = at(row.alpha2, row.specular2);
    const double of_pixels =
        loss.of_pixels(grey_material(builtin_renderer().model(target), row.alpha2, row.specular2, 0.0));
    CHECK(row.error == Approx(std::sqrt(of_pixels)).epsilon(1e-4));
    for (const double step : {-2e-3, 2e-3}) {
      CHECK(at(row.alpha2 + step, row.specular2) > least);
      CHECK(at(row.alpha2, row.specular2 + step) > least);
    }
  }
}

TEST_CASE("objective: paper is a headlight and weights of 1") {
  const Objective paper = objective_preset("paper");
  CHECK(paper.lights == std::vector<Light>{Light{}});
  const std::vector<float> source = {0.0f, 3.0f}, cosines = {1.0f, 0.1f};
  CHECK(squared_weights(paper, source, cosines).squared == std::vector<float>{1.0f, 1.0f});
}

TEST_CASE("objective: an unknown name is refused with the nearest") {
  CHECK_THROWS_WITH(objective_preset("papper"), Catch::Contains("did you mean paper?"));
}
