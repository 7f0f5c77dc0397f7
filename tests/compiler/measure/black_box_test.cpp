// This file tests sweeps of renderers with unknown names, scales, light and laws of specular.
#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "compiler/measure/sweep_session.hpp"
#include "compiler/renderer/disguised_renderer.hpp"
#include "measure/picture_taker.hpp"
#include "remap/error.hpp"
#include "renderer/fresnel.hpp"
#include "table/table.hpp"

using namespace remap;

namespace {

SpecularResponse probe(const Renderer& renderer, const std::string& model,
                       const Range& alphas = {0.05, 1.0}) {
  const PictureTaker picture_taker(renderer, objective_preset("natural"), 64, 1);
  return probe_specular(picture_taker, renderer.model(model), alphas);
}

double squared(double level) { return level * level; }

// Returns a quadratic with a linear part, as in three.js, which is neither proportional nor affine.
double mixed(double level) { return 0.3 * level + 0.7 * level * level; }

}  // namespace

TEST_CASE("sweep: a renderer with other names, scales and light is matched as if light were equal") {
  const auto samples = grid_samples({0.1, 0.7}, 3, {0.0, 1.0}, 4);
  SweepOptions options = sweep_options("mitsuba/ward", "disguised/metal", "natural", samples, 96);
  options.accept_light = true;
  for (const double light : {0.013, 0.5, 1.0, 7.5}) {
    const BothRenderers renderers(light);
    const Table table = sweep(renderers, options);
    CHECK(comment(table, "light_accepted") == (light == 1.0 ? "" : "yes"));
    CHECK(std::stod(comment(table, "irradiance_scale")) == Approx(light).epsilon(1e-6));
    CHECK(comment(table, "diffuse_scale") == "1");
    // The disguised model divides Ward's alpha by 0.8 and multiplies its specular by 4.
    for (const TableRow& row : table.rows) {
      CHECK(row.status == (row.specular1 < 1.0 ? RowStatus::kOk : row.status));
      CHECK(row.specular2 == Approx(row.specular1 * 4.0).epsilon(1e-6));
      CHECK(row.alpha2 == Approx(row.alpha1 / 0.8).epsilon(1e-6));
    }
  }
}

TEST_CASE("sweep: light is matched in the other direction too") {
  SweepOptions options =
      sweep_options("disguised/metal", "mitsuba/ward", "paper", {{0.3, 2.0}, {0.6, 1.0}}, 96);
  options.accept_light = true;
  for (const double light : {0.013, 7.5}) {
    const Table table = sweep(BothRenderers(light), options);
    CHECK(std::stod(comment(table, "irradiance_scale")) == Approx(1.0 / light).epsilon(1e-6));
    CHECK(table.rows[0].specular2 == Approx(0.5).epsilon(1e-6));
    CHECK(table.rows[1].specular2 == Approx(0.25).epsilon(1e-6));
    CHECK(table.rows[1].alpha2 == Approx(0.48).epsilon(1e-6));
  }
}

TEST_CASE("sweep: without irradiance matching, the light's factor remains in specular and diffuse") {
  auto options = sweep_options("mitsuba/ward", "disguised/metal", "natural", {{0.3, 0.2}, {0.3, 0.9}}, 96);
  options.match_irradiance = false;
  const Table table = sweep(BothRenderers(0.5), options);
  CHECK(comment(table, "irradiance_scale") == "1");
  CHECK(std::stod(comment(table, "diffuse_scale")) == Approx(2.0).epsilon(1e-6));
  CHECK(table.rows[0].specular2 == Approx(1.6).epsilon(1e-6));
  CHECK(table.rows[1].status == RowStatus::kBright);
  CHECK(table.rows[1].specular2 == 4.0);
}

TEST_CASE("sweep: one and three stages match unknown light, width, specular and diffuse at once") {
  for (const int stages : {1, 3}) {
    for (const double light : {0.013, 7.5}) {
      auto options =
          sweep_options("mitsuba/ward", "disguised/metal", "natural", {{0.2, 0.4}, {0.4, 0.7}}, 96);
      options.stages = stages;
      options.diffuse = 0.35;
      options.accept_light = true;
      const Table table = sweep(BothRenderers(light), options);
      REQUIRE(table.has_diffuse);
      for (const TableRow& row : table.rows) {
        // Interpolation between the nodes of the bank is exact to 1e-6. The rest is the tolerance of the
        // search.
        CHECK(row.specular2 == Approx(row.specular1 * 4.0).epsilon(1e-4));
        CHECK(row.alpha2 == Approx(row.alpha1 / 0.8).epsilon(1e-4));
        CHECK(row.diffuse2 == Approx(0.35).epsilon(1e-4));
        CHECK(row.error < 1e-4);
        CHECK(row.status == RowStatus::kOk);
      }
    }
  }
}

TEST_CASE("sweep: diffuse is matched apart from specular") {
  const BothRenderers renderers(0.5);
  const PictureTaker picture_taker(renderers, objective_preset("natural"), 64, 1);
  const DiffuseMatch match =
      match_diffuse(picture_taker, renderers.model("mitsuba/ggx"), renderers.model("disguised/metal"));
  CHECK(match.scale == Approx(2.0).epsilon(1e-6));
  CHECK(match.error < 1e-5);
}

TEST_CASE("probe: pictures distinguish a scale from Schlick's Fresnel") {
  CHECK(probe(builtin_renderer(), "mitsuba/ward").law == SpecularLaw::kProportional);
  CHECK(probe(builtin_renderer(), "mitsuba/ggx").law == SpecularLaw::kAffine);
  CHECK_FALSE(probe(builtin_renderer(), "mitsuba/ggx").proportional());
}

TEST_CASE("probe: the laws of the built-in models with indices and knees") {
  for (const std::string name : {"as", "ggx", "beckmann"}) {
    CHECK(probe(builtin_renderer(), "mitsuba/" + name + "-ior").law == SpecularLaw::kIor);
    // The shape of exact Fresnel depends on the index, so no coordinate is linear.
    CHECK(probe(builtin_renderer(), "mitsuba/" + name + "-dielectric").law == SpecularLaw::kOther);
  }
  const SpecularResponse trimmed = probe(builtin_renderer(), "mitsuba/ward-conserving");
  CHECK(trimmed.law == SpecularLaw::kClamped);
  CHECK(trimmed.knee == Approx(1.0).epsilon(1e-6));
}

TEST_CASE("probe: an index of refraction is found where pictures are affine in its F0") {
  const LawRenderer schlick("mitsuba/ggx", {1.0, 2.5}, [](double ior) { return normal_reflectance(ior); });
  CHECK(probe(schlick, "disguised/law").law == SpecularLaw::kIor);
  const LawRenderer scale("mitsuba/ward", {1.2, 3.0}, [](double ior) { return normal_reflectance(ior); });
  const SpecularResponse response = probe(scale, "disguised/law");
  CHECK(response.law == SpecularLaw::kIor);
  CHECK(response.canonical(1.5) == Approx(0.04).epsilon(1e-12));
  CHECK(response.native(0.04) == Approx(1.5).epsilon(1e-12));
}

TEST_CASE("probe: a knee is found to the precision of pictures, wherever it lies") {
  for (const double knee : {0.004, 0.37, 1.0, 1.9}) {
    const LawRenderer trimmed("mitsuba/ward", {0.0, 2.0},
                              [&](double level) { return std::min(level, knee) / 2.0; });
    const SpecularResponse response = probe(trimmed, "disguised/law");
    CHECK(response.law == SpecularLaw::kClamped);
    CHECK(response.knee == Approx(knee).epsilon(1e-4));
    CHECK(response.proportional());
  }
}

TEST_CASE("probe: an unknown law is called other, with its deviation from affine") {
  for (const auto law : {squared, mixed}) {
    const SpecularResponse response = probe(LawRenderer("mitsuba/ward", {0.0, 1.0}, law), "disguised/law");
    CHECK(response.law == SpecularLaw::kOther);
    CHECK(response.residual > 0.1);
  }
  // The law rises, is flat, and rises again, so it has no knee.
  const LawRenderer stairs("mitsuba/ward", {0.0, 1.0},
                           [](double level) { return level < 0.4 ? level : std::max(0.4, level - 0.3); });
  CHECK(probe(stairs, "disguised/law").law == SpecularLaw::kOther);
}

TEST_CASE("sweep: a target with an index is matched in F0, its own parameter is named") {
  const LawRenderer renderer("mitsuba/ggx", {1.0, 2.5}, [](double ior) { return normal_reflectance(ior); });
  const auto samples = grid_samples({0.1, 0.6}, 3, {0.0, 0.12}, 3);
  const Table table =
      sweep(renderer, sweep_options("mitsuba/beckmann", "disguised/law", "natural", samples, 64));
  const Table same =
      sweep(renderer, sweep_options("mitsuba/beckmann", "mitsuba/ggx", "natural", samples, 64));
  CHECK(comment(table, "target_specular") == "level");
  CHECK(comment(table, "target_specular_law") == "ior");
  CHECK(comment(table, "target_specular_column") == "f0");
  CHECK(table.target.specular == "f0");
  for (std::size_t i = 0; i < samples.size(); ++i) {
    CHECK(table.rows[i].alpha2 == Approx(same.rows[i].alpha2).epsilon(1e-5));
    CHECK(table.rows[i].specular2 == Approx(same.rows[i].specular2).epsilon(1e-4));
  }
}

TEST_CASE("sweep: a source with an index is sampled in F0") {
  const LawRenderer renderer("mitsuba/ggx", {1.0, 2.5}, [](double ior) { return normal_reflectance(ior); });
  const Range speculars = canonical_speculars(renderer, renderer.model("disguised/law"));
  CHECK(speculars.min == 0.0);
  CHECK(speculars.max == Approx(9.0 / 49.0));
  const std::vector<MappedTexel> samples = {{0.2, 0.04}, {0.4, 0.1}};
  const Table table = sweep(renderer, sweep_options("disguised/law", "mitsuba/ggx", "natural", samples, 64));
  for (const TableRow& row : table.rows) {
    CHECK(row.alpha2 == Approx(row.alpha1).epsilon(1e-5));
    CHECK(row.specular2 == Approx(row.specular1).epsilon(1e-5));
  }
  CHECK_THROWS_WITH(
      sweep(renderer, sweep_options("disguised/law", "mitsuba/ggx", "natural", {{0.2, 0.5}}, 64)),
      Catch::Contains("specular 0.5 of a sample is out of range"));
}

TEST_CASE("sweep: a target that clamps ends at its knee, a source that clamps is matched at it") {
  const LawRenderer renderer("mitsuba/ward", {0.0, 2.0}, [](double level) { return std::min(level, 0.5); });
  const Table to = sweep(renderer, sweep_options("mitsuba/ward", "disguised/law", "natural",
                                                 {{0.3, 0.25}, {0.3, 0.49}, {0.3, 0.51}, {0.3, 0.9}}, 64));
  CHECK(comment(to, "target_specular_knee") == "0.5");
  CHECK(to.rows[0].status == RowStatus::kOk);
  CHECK(to.rows[0].specular2 == Approx(0.25).epsilon(1e-5));
  CHECK(to.rows[1].status == RowStatus::kOk);
  for (const std::size_t beyond : {2u, 3u}) {
    CHECK(to.rows[beyond].status == RowStatus::kBright);
    CHECK(to.rows[beyond].specular2 == 0.5);
  }
  for (const std::string objective : {"natural-1", "natural-2", "paper"}) {
    const Table from = sweep(renderer, sweep_options("disguised/law", "mitsuba/ward", objective,
                                                     {{0.3, 0.25}, {0.3, 0.75}, {0.3, 2.0}}, 64));
    CHECK(from.rows[0].specular2 == Approx(0.25).epsilon(1e-5));
    CHECK(from.rows[1].specular2 == Approx(0.5).epsilon(1e-5));
    CHECK(from.rows[2].specular2 == Approx(0.5).epsilon(1e-5));
  }
}

TEST_CASE("sweep: a target without a known law is matched") {
  const auto inverse = [](double specular) {  // inverse of mixed()
    return (-0.3 + std::sqrt(0.09 + 2.8 * specular)) / 1.4;
  };
  const LawRenderer renderer("mitsuba/ward", {0.0, 1.0}, mixed);
  const auto samples = grid_samples({0.1, 0.7}, 3, {0.0, 0.9}, 3);
  const Table table = sweep(renderer, sweep_options("mitsuba/ward", "disguised/law", "natural", samples, 48));
  CHECK(comment(table, "target_specular_law") == "other");
  for (const TableRow& row : table.rows) {
    // The margin allows for central differences of float pictures and for the tolerances of the search.
    CHECK(row.alpha2 == Approx(row.alpha1).epsilon(1e-4));
    CHECK(row.specular2 == Approx(inverse(row.specular1)).epsilon(1e-4));
    CHECK(row.status == RowStatus::kOk);
  }
}

TEST_CASE("sweep: a target without a known law that cannot match gets the result of affine matching") {
  const LawRenderer renderer("mitsuba/ggx-plain", {0.0, 1.0}, squared);
  const std::vector<MappedTexel> samples = {{0.15, 0.5}, {0.3, 0.3}};
  const Table table = sweep(renderer, sweep_options("mitsuba/ward", "disguised/law", "natural", samples, 64));
  const Table same =
      sweep(renderer, sweep_options("mitsuba/ward", "mitsuba/ggx-plain", "natural", samples, 64));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    CHECK(table.rows[i].alpha2 == Approx(same.rows[i].alpha2).epsilon(1e-4));
    CHECK(squared(table.rows[i].specular2) == Approx(same.rows[i].specular2).epsilon(1e-4));
    CHECK(table.rows[i].error == Approx(same.rows[i].error).epsilon(1e-4));
  }
}

TEST_CASE("sweep: exact Fresnel as a target is matched in its index") {
  const Table table =
      sweep(builtin_renderer(), sweep_options("mitsuba/as-dielectric", "mitsuba/as-dielectric", "natural",
                                              {{0.2, 1.0}, {0.2, 1.5}, {0.4, 2.2}}, 48));
  CHECK(table.target.specular == "ior");
  CHECK(table.rows[0].status == RowStatus::kFlat);
  CHECK(table.rows[0].specular2 == 1.0);
  for (const std::size_t i : {1u, 2u}) {
    CHECK(table.rows[i].alpha2 == Approx(table.rows[i].alpha1).epsilon(1e-3));
    CHECK(table.rows[i].specular2 == Approx(table.rows[i].specular1).epsilon(1e-3));
    CHECK(table.rows[i].status == RowStatus::kOk);
  }
}

TEST_CASE("sweep: a source that is not affine is rendered sample by sample") {
  const LawRenderer renderer("mitsuba/ward", {0.0, 1.0}, squared);
  const auto samples = grid_samples({0.2, 0.4}, 2, {0.0, 0.9}, 3);
  for (const TableRow& row :
       sweep(renderer, sweep_options("disguised/law", "mitsuba/beckmann-plain", "natural", samples, 64))
           .rows) {
    const auto same = sweep(renderer, sweep_options("mitsuba/ward", "mitsuba/beckmann-plain", "natural",
                                                    {{row.alpha1, squared(row.specular1)}}, 64));
    CHECK(row.alpha2 == Approx(same.rows.front().alpha2).epsilon(1e-5));
    CHECK(row.specular2 == Approx(same.rows.front().specular2).epsilon(1e-5));
  }
}

TEST_CASE("black box: a source that is quadratic in specular takes one picture a width") {
  const LawRenderer renderer("mitsuba/ward", {0.0, 1.0}, [](double s) { return 0.4 * s + 0.3 * s * s; });
  SweepOptions options;
  options.source = "disguised/law";
  options.target = "mitsuba/ward";
  options.objective = objective_preset("paper");
  options.resolution = 64;
  options.samples = grid_samples({0.2, 0.6}, 2, {0.0, 1.0}, 5);
  const Table table = run_sweep(renderer, options, {});
  CHECK(std::find(table.comments.begin(), table.comments.end(),
                  std::pair<std::string, std::string>("source_specular_interpolated", "1 picture a width")) !=
        table.comments.end());
  for (const TableRow& row : table.rows) {
    CHECK(row.alpha2 == Approx(row.alpha1).margin(1e-6));
    CHECK(row.specular2 == Approx(0.4 * row.specular1 + 0.3 * row.specular1 * row.specular1).epsilon(1e-5));
  }
}

TEST_CASE("black box: a diffuse lobe of another shape is no other light: an error, unless it is accepted") {
  const ClayRenderer renderer(0.7);
  const auto samples = grid_samples({0.15, 0.7}, 6, {0.0, 0.5}, 3);
  SweepOptions options = sweep_options("disguised/clay", "mitsuba/ggx", "natural-1", samples, 64);
  CHECK_THROWS_WITH(sweep(renderer, options),
                    Catch::StartsWith("disguised/clay to mitsuba/ggx: diffuse matches only if the light of "
                                      "the source is multiplied by 1.") &&
                        Catch::Contains("specular2 is ") && Catch::Contains(" % larger") &&
                        Catch::Contains("--accept-light continues anyway"));
  options.accept_light = true;
  const Table accepted = sweep(renderer, options);
  const LightMatch match = light_match(accepted.comments);
  CHECK(match.scale > 1.1);
  CHECK(match.diffuse_error > 0.03);
  CHECK(match.accepted);
  // This shows why the rule exists: the lobes are the same, but the match gives another specular.
  for (const TableRow& row : accepted.rows)
    if (row.specular1 > 0.1) CHECK(row.specular2 > 1.05 * row.specular1);
  CHECK_FALSE(light_remark(match).empty());
  CHECK_FALSE(is_wrong_light(match));
  options.match_irradiance = false;
  options.accept_light = false;
  for (const TableRow& row : sweep(renderer, options).rows)
    if (row.status == RowStatus::kOk) CHECK(row.specular2 == Approx(row.specular1).margin(1e-5));
}

TEST_CASE("black box: a diffuse lobe that differs little is a remark, not an error") {
  SweepOptions options = sweep_options("disguised/clay", "mitsuba/ggx", "natural",
                                       grid_samples({0.2, 0.6}, 2, {0.0, 0.5}, 2), 64);
  const LightMatch match = light_match(sweep(ClayRenderer(0.12), options).comments);
  CHECK_FALSE(light_remark(match).empty());
  CHECK_FALSE(is_wrong_light(match));
  CHECK(light_remark(light_match(sweep(ClayRenderer(0.0), options).comments)).empty());
}
