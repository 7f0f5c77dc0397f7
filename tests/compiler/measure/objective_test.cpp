// Lights and weights of an objective.
#include "measure/objective.hpp"

#include <catch2/catch.hpp>

#include "remap/error.hpp"

using namespace remap;

TEST_CASE("objective: natural weighs each pixel by cos_view / (I / max(I) + 0.1), squared") {
  const Objective natural = objective_preset("natural");
  REQUIRE(natural.lights == std::vector<Light>{{60.0, 3.0}});
  const std::vector<float> source = {0.0f, 1.0f, 4.0f}, cosines = {1.0f, 0.5f, 0.8f};
  const auto weights = squared_weights(natural, source, cosines);
  CHECK(weights[0] == Approx(100.0));
  CHECK(weights[1] == Approx(0.5 / 0.35 * 0.5 / 0.35));
  CHECK(weights[2] == Approx(0.8 / 1.1 * 0.8 / 1.1));
}

TEST_CASE("objective: natural uses the brightest pixel of each light separately") {
  Objective objective = objective_preset("natural");
  objective.lights = {Light{}, Light{60.0}};
  const std::vector<float> source = {1.0f, 2.0f, 10.0f, 20.0f}, cosines = {1.0f, 1.0f};
  const auto weights = squared_weights(objective, source, cosines);
  CHECK(weights[0] == weights[2]);
  CHECK(weights[1] == weights[3]);
}

TEST_CASE("objective: paper is a headlight and weights of 1") {
  const Objective paper = objective_preset("paper");
  CHECK(paper.lights == std::vector<Light>{Light{}});
  const std::vector<float> source = {0.0f, 3.0f}, cosines = {1.0f, 0.1f};
  CHECK(squared_weights(paper, source, cosines) == std::vector<float>{1.0f, 1.0f});
}

TEST_CASE("objective: an unknown name is refused with the nearest") {
  CHECK_THROWS_WITH(objective_preset("papper"), Catch::Contains("did you mean paper?"));
}
