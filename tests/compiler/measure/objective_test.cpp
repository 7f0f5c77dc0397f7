// This file tests the lights and weights of an objective.
#include "measure/objective.hpp"

#include <cmath>
#include <numeric>

#include <catch2/catch.hpp>

#include "measure/sweep.hpp"
#include "remap/error.hpp"
#include "sweep_session.hpp"

using namespace remap;

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
  const auto renderer = make_builtin_renderer();
  constexpr int kSide = 64;
  using Pair = std::pair<std::string, std::string>;
  for (const Pair& pair : {Pair{"mitsuba/ggx", "mitsuba/beckmann"}, Pair{"mitsuba/ward", "mitsuba/ggx"}}) {
    const auto& source = pair.first;
    const auto& target = pair.second;
    INFO(source);
    const TableRow row =
        sweep(*renderer, sweep_options(source, target, "natural-2", {{0.31, 0.37}}, kSide)).rows.front();
    const NaturalLoss loss(*renderer, grey_material(renderer->model(source), 0.31, 0.37, 0.0), kSide);
    const auto at = [&](double alpha, double specular) {
      return loss(grey_material(renderer->model(target), alpha, specular, 0.0));
    };
    const double least = at(row.alpha2, row.specular2);
    const double of_pixels =
        loss.of_pixels(grey_material(renderer->model(target), row.alpha2, row.specular2, 0.0));
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
