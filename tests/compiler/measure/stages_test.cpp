// This file tests diffuse and specular together: one, two and three stages (section 3.1 of the paper).
#include <atomic>
#include <cmath>

#include <catch2/catch.hpp>

#include "compiler/measure/sweep_session.hpp"
#include "measure/match.hpp"
#include "remap/error.hpp"

using namespace remap;

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
  const auto renderer = make_builtin_renderer();
  for (const int stages : {1, 2, 3})
    for (const std::string model : {"mitsuba/ward", "mitsuba/ggx", "mitsuba/phong"}) {
      SweepOptions options = staged(stages, {{0.15, 0.3}, {0.3, 0.6}});
      options.source = options.target = model;
      for (const TableRow& row : sweep(*renderer, options).rows) {
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
  const auto renderer = make_builtin_renderer();
  const auto samples = grid_samples({0.1, 0.5}, 3, {0.0, 0.4}, 3);
  const Table two = sweep(*renderer, staged(2, samples)), three = sweep(*renderer, staged(3, samples));
  const Table one = sweep(*renderer, staged(1, samples));
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
  const auto renderer = make_builtin_renderer();
  const std::vector<MappedTexel> samples = {{0.2, 0.3}, {0.4, 0.5}};
  const Table with = sweep(*renderer, staged(2, samples)),
              without = sweep(*renderer, staged(2, samples, 0.0));
  CHECK_FALSE(without.has_diffuse);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    CHECK(with.rows[i].alpha2 == without.rows[i].alpha2);
    CHECK(with.rows[i].specular2 == without.rows[i].specular2);
    // the error covers the whole picture, and diffuse is equal in both
    CHECK(with.rows[i].error < without.rows[i].error);
  }
}

TEST_CASE("stages: the joint match is a minimum of the whole picture as direct renders show it") {
  const auto renderer = make_builtin_renderer();
  const SweepOptions options = staged(3, {{0.3, 0.3}});
  const TableRow row = sweep(*renderer, options).rows.front();
  const PictureTaker picture_taker(*renderer, options.objective, options.resolution, 1);
  const auto source = picture_taker.take(renderer->model("mitsuba/as"), RoleValues{0.3, 0.3, 0.3});
  const auto loss = [&](double alpha, double specular, double diffuse) {
    const auto target =
        picture_taker.take(renderer->model("mitsuba/ward"), RoleValues{alpha, specular, diffuse});
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
  const auto renderer = make_builtin_renderer();
  const Table table = sweep(*renderer, staged(1, {{0.6, 0.9}}));
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
  const auto renderer = make_builtin_renderer();
  // specular is an index, and 1 means no boundary at all
  SweepOptions options = staged(1, {{0.3, 1.0}, {0.3, 1.5}}, 0.0);
  options.source = "mitsuba/as-dielectric";
  const Table table = sweep(*renderer, options);
  CHECK(table.rows[0].status == RowStatus::kFlat);
  CHECK(table.rows[0].specular2 == 0.0);
  CHECK(table.rows[1].specular2 > 0.01);
}

TEST_CASE(
    "stages: tables with diffuse are the same for any number of threads, and options out of range are "
    "refused") {
  const auto renderer = make_builtin_renderer();
  const SweepOptions options = staged(3, grid_samples({0.2, 0.5}, 3, {0.0, 0.5}, 2));
  CHECK(table_text(sweep(*renderer, options, 1)) == table_text(sweep(*renderer, options, 2)));
  CHECK_THROWS_WITH(sweep(*renderer, staged(4, {{0.3, 0.3}})), Catch::Contains("stages: 4 is out of range"));
  CHECK_THROWS_WITH(sweep(*renderer, staged(2, {{0.3, 0.3}}, 1.5)),
                    Catch::Contains("diffuse 1.5 is out of range"));
}
