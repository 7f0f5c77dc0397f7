// This file compares real renderers with the built-in hub. If a renderer is not installed
// (scripts/renderers), its test is skipped with a message. The environment variable REMAP_REQUIRE lists
// renderers whose absence is a failure.
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <memory>

#include <catch2/catch.hpp>

#include "measure/sweep.hpp"
#include "remap/error.hpp"
#include "support/skip.hpp"
#include "worker/renderer_set.hpp"

using namespace remap;

namespace {

WorkerSettings settings() {
  WorkerSettings settings;
  settings.processes = 2;
  return settings;
}

// Returns true if a model of the worker `name` can be rendered. Otherwise skips the test.
bool is_here(const RendererSet& renderers, const std::string& name, const std::string& model) {
  try {
    renderers.model(name + "/" + model);
    return true;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    skip(name, error.what());
    return false;
  }
}

// A Disagreement holds differences of two pictures, relative to the brightest pixel of `b`.
struct Disagreement {
  double rms = 0.0;      // over the whole picture
  double inside = 0.0;   // largest difference except at grazing views
  double largest = 0.0;  // largest difference
};

// At the silhouette, floats compute a cosine of 1e-3 with a relative error of 1e-4.
constexpr float kGrazing = 0.1f;

Disagreement disagreement(const Renderer& renderers, const Material& found, const Material& expected,
                          const Scene& scene) {
  const Image a = renderers.render(found, scene), b = renderers.render(expected, scene);
  REQUIRE(a.values.size() == b.values.size());
  const std::vector<float> cosines = view_cosines(scene.resolution, 1);
  Disagreement result;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const double off = std::fabs(static_cast<double>(a.values[i]) - static_cast<double>(b.values[i]));
    result.rms += off * off / static_cast<double>(a.values.size());
    result.largest = std::max(result.largest, off);
    if (cosines[i / static_cast<std::size_t>(a.channels)] > kGrazing)
      result.inside = std::max(result.inside, off);
  }
  const double peak = *std::max_element(b.values.begin(), b.values.end());
  return {std::sqrt(result.rms) / peak, result.inside / peak, result.largest / peak};
}

Table small_sweep(const Renderer& renderers, const std::string& source, const std::string& target,
                  const Range& alphas, double specular = 0.5) {
  SweepOptions options;
  options.source = source;
  options.target = target;
  options.objective = objective_preset("paper");
  options.resolution = 256;
  options.samples = grid_samples(alphas, 6, {0.0, specular}, 2);
  return run_sweep(renderers, options, {});
}

// Checks the largest change of alpha, and the largest relative change of specular, over rows within the
// target's range.
void check_identity(const Table& table, double alpha_tolerance, double specular_tolerance) {
  for (const TableRow& row : table.rows) {
    INFO("alpha " << row.alpha1 << " specular " << row.specular1);
    CHECK(row.alpha2 == Approx(row.alpha1).margin(alpha_tolerance));
    CHECK(row.specular2 == Approx(row.specular1).epsilon(specular_tolerance));
  }
}

}  // namespace

TEST_CASE("real renderers: Mitsuba 3 renders the hub's ggx and beckmann", "[slow]") {
  const RendererSet renderers(known_workers({}), settings());
  if (!is_here(renderers, "mitsuba3", "ggx")) return;
  Disagreement worst;
  for (const std::string model : {"ggx", "beckmann"})
    for (const double alpha : {0.03, 0.1, 0.3, 0.6, 0.99})
      for (const double angle : {0.0, 45.0}) {
        const auto material = [&](const std::string& name) {
          return Material{name, {{"alpha", {alpha}}, {"specular", {1.0}}, {"diffuse", {0.0}}}};
        };
        const Disagreement off =
            disagreement(renderers, material("mitsuba3/" + model), material("mitsuba/" + model + "-plain"),
                         {256, 1, {angle, 3.0}});
        INFO(model << " alpha " << alpha << " light " << angle);
        CHECK(off.rms < 1e-5);
        // One pixel on the flank of a highlight of alpha 0.03 differs by 1.2e-5, because Mitsuba uses floats.
        CHECK(off.inside < 2e-5);
        worst = {std::max(worst.rms, off.rms), std::max(worst.inside, off.inside),
                 std::max(worst.largest, off.largest)};
      }
  std::cout << "Mitsuba 3 against the hub, ggx and beckmann at 256^2, of the peak: rms " << worst.rms
            << ", largest " << worst.inside << ", at the silhouette " << worst.largest << "\n";
}

TEST_CASE("real renderers: Mitsuba 3's diffuse adds to its highlight", "[slow]") {
  const RendererSet renderers(known_workers({}), settings());
  if (!is_here(renderers, "mitsuba3", "ggx")) return;
  const auto material = [&](const std::string& name) {
    return Material{name, {{"alpha", {0.4}}, {"specular", {0.9, 0.6, 0.1}}, {"diffuse", {0.1, 0.4, 0.8}}}};
  };
  const Scene scene{64, 3, {60.0, 3.0}};
  CHECK(disagreement(renderers, material("mitsuba3/ggx"), material("mitsuba/ggx-plain"), scene).rms < 1e-5);
}

TEST_CASE("real renderers: Mitsuba 3 shows the torus, from its mesh, as the hub does", "[slow]") {
  const RendererSet renderers(known_workers({}), settings());
  if (!is_here(renderers, "mitsuba3", "ggx")) return;
  const auto material = [&](const std::string& name) {
    return Material{name, {{"alpha", {0.3}}, {"specular", {0.6}}, {"diffuse", {0.3}}}};
  };
  for (const double angle : {0.0, 60.0}) {
    const Scene scene{128, 1, {angle, 3.0}, 0, Shape::kTorus};
    // The margin allows for facets (1e-4), and for pixels at the edges of the shape and of its shadow.
    CHECK(disagreement(renderers, material("mitsuba3/ggx"), material("mitsuba/ggx-plain"), scene).rms < 5e-3);
  }
}

TEST_CASE("real renderers: hub to Mitsuba 3 is the identity", "[slow]") {
  const RendererSet renderers(known_workers({}), settings());
  if (!is_here(renderers, "mitsuba3", "ggx")) return;
  check_identity(small_sweep(renderers, "mitsuba/ggx-plain", "mitsuba3/ggx", {0.03, 0.9}), 1e-5, 1e-4);
  check_identity(small_sweep(renderers, "mitsuba/beckmann-plain", "mitsuba3/beckmann", {0.03, 0.9}), 1e-5,
                 1e-4);
}

TEST_CASE("real renderers: Radiance's plastic equals the hub's balanced Ward", "[slow]") {
  const RendererSet renderers(known_workers({}), settings());
  if (!is_here(renderers, "radiance", "plastic")) return;
  check_identity(small_sweep(renderers, "radiance/plastic", "mitsuba/ward-balanced", {0.03, 0.9}), 1e-5,
                 1e-5);
}

TEST_CASE("real renderers: Cycles 3.4's GGX equals the hub's", "[slow]") {
  const RendererSet renderers(known_workers({}), settings());
  if (!is_here(renderers, "cycles-3.4", "ggx")) return;
  check_identity(small_sweep(renderers, "cycles-3.4/ggx", "mitsuba/ggx-plain", {0.03, 0.9}), 1e-4, 1e-3);
}

TEST_CASE("real renderers: Cycles 5's GGX follows the curve of its other masking", "[slow]") {
  const RendererSet renderers(known_workers({}), settings());
  if (!is_here(renderers, "cycles-5", "ggx")) return;
  SweepOptions options;
  options.source = "cycles-5/ggx";
  options.target = "mitsuba/ggx-plain";
  options.objective = objective_preset("paper");
  options.resolution = 128;
  // Another search found these values at 128^2, with formulas in NumPy. They convert from separable to
  // height-correlated Smith shadowing.
  const std::vector<std::array<double, 3>> curve = {
      {0.3, 0.30007, 1.0003}, {0.6, 0.60543, 1.0114}, {0.75, 0.77122, 1.0363}, {0.85, 0.89633, 1.0723}};
  for (const auto& point : curve) options.samples.push_back({point[0], 0.5});
  const Table table = run_sweep(renderers, options, {});
  for (std::size_t i = 0; i < curve.size(); ++i) {
    CHECK(table.rows[i].alpha2 == Approx(curve[i][1]).margin(1e-3));
    CHECK(table.rows[i].specular2 / 0.5 == Approx(curve[i][2]).margin(1e-3));
  }
}

TEST_CASE("real renderers: Radiance to three.js, quadratic in F0, follows the curve of another search",
          "[slow]") {
  const RendererSet renderers(known_workers({}), settings());
  if (!is_here(renderers, "radiance", "plastic") || !is_here(renderers, "threejs-r187", "standard-metal"))
    return;
  SweepOptions options;
  options.source = "radiance/plastic";
  options.target = "threejs-r187/standard-metal";
  options.objective = objective_preset("paper");
  options.resolution = 256;
  // These were found by a search in Python over 37 pictures of F0 0.04 and a parabola. They are alpha,
  // three.js' roughness, and F0 for each unit of Radiance's specularity.
  const std::vector<std::array<double, 3>> curve = {{0.05, 0.2303, 1.289}, {0.1, 0.3243, 1.267},
                                                    {0.2, 0.4508, 1.196},  {0.4, 0.6057, 1.011},
                                                    {0.6, 0.7097, 0.863},  {0.9, 0.8348, 0.733}};
  for (const auto& point : curve) options.samples.push_back({point[0], 0.04 / point[2]});
  const Table table = run_sweep(renderers, options, {});
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const double roughness = from_alpha(RoughnessEncoding::kRoughness, table.rows[i].alpha2);
    CHECK(roughness == Approx(curve[i][1]).margin(2e-3));
    // The search assumed that pictures are proportional to F0. This is true except for the light that
    // Schlick's Fresnel gives at F0 0.
    CHECK(table.rows[i].specular2 == Approx(0.04).epsilon(0.02));
    CHECK(table.rows[i].status == RowStatus::kOk);
  }
  // The pictures are probes of both laws (9 and 9) and of the family (27), one per width and two per sphere
  // (6 and 12), and three per node. Each width needs a window of twelve nodes and two neighbours. The coarse
  // search needs every sixth of 110 nodes.
  const std::size_t pictures = renderers.pictures().rendered;
  CHECK(pictures <= 9 + 9 + 27 + 6 + 12 + 3 * (6 * 14 + 19));
  std::cout << "Radiance to three.js, six widths at 256^2: " << pictures << " pictures\n";
}

TEST_CASE(
    "real renderers: a material of MuJoCo is Blinn's lobe, not normalised, with n = 128 times its shininess",
    "[slow][needs]") {
  const RendererSet renderers(known_workers({}), settings());
  if (!is_here(renderers, "mujoco", "material")) return;
  for (const double exponent : {5.0, 32.0, 128.0})
    for (const double angle : {0.0, 30.0, 60.0}) {
      CAPTURE(exponent, angle);
      const auto with = [&](const std::string& model) {
        return Material{model, {{"exponent", {exponent}}, {"specular", {0.6}}, {"diffuse", {0.3}}}};
      };
      // MuJoCo's framebuffer has 8 bits, and its sphere is a grid.
      const Disagreement off =
          disagreement(renderers, with("mujoco/material"), with("legacy/blinn-phong"), {96, 1, {angle, 3.0}});
      CHECK(off.rms < 0.002);
      CHECK(off.inside < 0.03);  // at one pixel at the edge of the light, where the lobe is cut off
    }
}
