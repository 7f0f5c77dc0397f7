// The built-in renderer against closed forms at single pixels, and the properties that its models promise.
#include "sweep/renderer.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "error.hpp"
#include "sweep/brdf.hpp"

using namespace remapc;
using std::numbers::pi;

namespace {

// Radiance of the pixel that looks along the normal under a headlight: light 2 away, all cosines 1.
double central_radiance(const std::string& model, const std::string& width, double value,
                        const std::string& specular) {
  const auto renderer = make_builtin_renderer();
  const Image image =
      renderer->render({model, {{width, {value}}, {specular, {0.5}}, {"diffuse", {0.0}}}}, {33, 1, Light{}});
  return image.values[16 * 33 + 16];
}

LocalGeometry geometry(double cos_light, double cos_view, double azimuth) {
  const double sin_light = std::sqrt(1.0 - cos_light * cos_light),
               sin_view = std::sqrt(1.0 - cos_view * cos_view);
  const double between = cos_light * cos_view + sin_light * sin_view * std::cos(azimuth);
  const double half_length = std::sqrt(2.0 + 2.0 * between);
  return {cos_light,
          cos_view,
          (cos_light + cos_view) / half_length,
          half_length / 2.0,
          2.0 + 2.0 * between,
          2.0 * cos_light * cos_view - between};
}

constexpr Brdf kAllBrdfs[] = {
    Brdf::kWard, Brdf::kWardDuer, Brdf::kWardBalanced, Brdf::kPhong, Brdf::kBeckmann, Brdf::kGgx, Brdf::kAs};

// Reflected share of light that comes from `cos_light`, specular 1: midpoint rule over the hemisphere.
double directional_albedo(Brdf brdf, Fresnel fresnel, double alpha, double cos_light, double f0) {
  constexpr int kPolar = 400, kAzimuth = 400;
  double sum = 0.0;
  for (int i = 0; i < kPolar; ++i) {
    const double theta = (i + 0.5) * 0.5 * pi / kPolar;
    for (int j = 0; j < kAzimuth; ++j) {
      const double azimuth = (j + 0.5) * pi / kAzimuth;
      const Lobe lobe = evaluate_lobe(brdf, fresnel, alpha, geometry(cos_light, std::cos(theta), azimuth));
      sum += (lobe.base + f0 * lobe.slope) * std::cos(theta) * std::sin(theta);
    }
  }
  return sum * (0.5 * pi / kPolar) * (2.0 * pi / kAzimuth);
}

}  // namespace

TEST_CASE("renderer: radiance along the normal has the closed form of each model") {
  for (const double alpha : {0.1, 0.35, 0.8}) {
    const double a2 = alpha * alpha;
    const double exponent = 2.0 / a2 - 2.0;
    // brdf * cos / distance^2 with specular 0.5 and distance 2.
    const double lambert = 0.5 / 4.0;
    CHECK(central_radiance("mitsuba/ward", "alpha", alpha, "specular") == Approx(lambert / (4 * pi * a2)));
    CHECK(central_radiance("mitsuba/ward-duer", "alpha", alpha, "specular") ==
          Approx(lambert / (4 * pi * a2)));
    CHECK(central_radiance("mitsuba/ward-balanced", "alpha", alpha, "specular") ==
          Approx(lambert / (4 * pi * a2)));
    CHECK(central_radiance("mitsuba/phong", "exponent", exponent, "specular") ==
          Approx(lambert * (exponent + 2) / (2 * pi)));
    CHECK(central_radiance("mitsuba/beckmann", "alpha", alpha, "f0") == Approx(lambert / (4 * pi * a2)));
    CHECK(central_radiance("mitsuba/ggx", "alpha", alpha, "f0") == Approx(lambert / (4 * pi * a2)));
    CHECK(central_radiance("mitsuba/as", "alpha", alpha, "f0") ==
          Approx(lambert * (exponent + 2) / (8 * pi)));
  }
}

TEST_CASE("renderer: a diffuse sphere is Lambert's, scaled by the distance of the light") {
  const auto renderer = make_builtin_renderer();
  const Material material{"mitsuba/ward", {{"alpha", {0.5}}, {"specular", {0.0}}, {"diffuse", {0.8}}}};
  const Image near = renderer->render(material, {33, 1, {0.0, 3.0}});
  CHECK(near.values[16 * 33 + 16] == Approx(0.8 / pi / 4.0));
  const Image far = renderer->render(material, {33, 1, {0.0, 11.0}});
  CHECK(far.values[16 * 33 + 16] == Approx(0.8 / pi / 100.0));
  // At 60 degrees the pole sees the light under the angle of the triangle pole - light.
  const Image side = renderer->render(material, {33, 1, {60.0, 3.0}});
  const double dx = 3.0 * std::sin(pi / 3), dz = 3.0 * std::cos(pi / 3) - 1.0;
  const double distance_2 = dx * dx + dz * dz;
  CHECK(side.values[16 * 33 + 16] == Approx(0.8 / pi * dz / std::sqrt(distance_2) / distance_2));
}

TEST_CASE("renderer: colour makes three channels, each as the grey picture of its value") {
  const auto renderer = make_builtin_renderer();
  const Scene scene{24, 1, {30.0, 3.0}};
  const Image rgb = renderer->render(
      {"mitsuba/ggx", {{"alpha", {0.3}}, {"f0", {0.9, 0.5, 0.1}}, {"diffuse", {0.2}}}}, scene);
  REQUIRE(rgb.channels == 3);
  const double values[] = {0.9, 0.5, 0.1};
  for (std::size_t c = 0; c < 3; ++c) {
    const Image grey =
        renderer->render({"mitsuba/ggx", {{"alpha", {0.3}}, {"f0", {values[c]}}, {"diffuse", {0.2}}}}, scene);
    REQUIRE(grey.channels == 1);
    for (std::size_t i = 0; i < grey.values.size(); ++i) REQUIRE(rgb.values[3 * i + c] == grey.values[i]);
  }
}

TEST_CASE("renderer: a grid in each pixel converges to the mean of a finer picture") {
  const auto renderer = make_builtin_renderer();
  const Material material{"mitsuba/beckmann", {{"alpha", {0.2}}, {"f0", {1.0}}, {"diffuse", {0.0}}}};
  const Image coarse = renderer->render(material, {16, 4, {20.0, 3.0}});
  const Image fine = renderer->render(material, {64, 1, {20.0, 3.0}});
  for (std::size_t row = 0; row < 16; ++row) {
    for (std::size_t column = 0; column < 16; ++column) {
      double sum = 0.0;
      for (std::size_t v = 0; v < 4; ++v)
        for (std::size_t u = 0; u < 4; ++u) sum += fine.values[(4 * row + v) * 64 + 4 * column + u];
      REQUIRE(coarse.values[row * 16 + column] == Approx(sum / 16.0).epsilon(1e-5).margin(1e-9));
    }
  }
}

TEST_CASE("brdf: microfacet distributions have projected area 1") {
  for (const Brdf brdf : {Brdf::kBeckmann, Brdf::kGgx, Brdf::kAs}) {
    for (const double alpha : {0.05, 0.3, 1.0}) {
      constexpr int kSteps = 200000;
      double sum = 0.0;
      for (int i = 0; i < kSteps; ++i) {
        const double theta = (i + 0.5) * 0.5 * pi / kSteps;
        sum += microfacet_distribution(brdf, alpha, std::cos(theta)) * std::cos(theta) * std::sin(theta);
      }
      CHECK(sum * 2.0 * pi * 0.5 * pi / kSteps == Approx(1.0).epsilon(1e-4));
    }
  }
}

TEST_CASE("brdf: light and view can change places") {
  for (const Brdf brdf : kAllBrdfs) {
    const Lobe there = evaluate_lobe(brdf, Fresnel::kSchlick, 0.4, geometry(0.9, 0.35, 1.1));
    const Lobe back = evaluate_lobe(brdf, Fresnel::kSchlick, 0.4, geometry(0.35, 0.9, 1.1));
    CHECK(there.base == Approx(back.base).epsilon(1e-12));
    CHECK(there.slope == Approx(back.slope).epsilon(1e-12));
  }
}

TEST_CASE("brdf: models that promise it never reflect more than they receive") {
  for (const Brdf brdf : {Brdf::kBeckmann, Brdf::kGgx, Brdf::kAs, Brdf::kWardBalanced})
    for (const double alpha : {0.2, 0.5, 1.0})
      for (const double cos_light : {0.99, 0.6, 0.2})
        CHECK(directional_albedo(brdf, Fresnel::kNone, alpha, cos_light, 1.0) <= 1.0 + 1e-3);
}

TEST_CASE("brdf: Schlick's Fresnel is F0 along the normal and 1 at grazing light") {
  const Lobe frontal = evaluate_lobe(Brdf::kGgx, Fresnel::kSchlick, 0.5, geometry(1.0, 1.0, 0.0));
  CHECK(frontal.base == 0.0);
  const Lobe plain = evaluate_lobe(Brdf::kGgx, Fresnel::kNone, 0.5, geometry(0.01, 0.01, pi));
  const Lobe grazing = evaluate_lobe(Brdf::kGgx, Fresnel::kSchlick, 0.5, geometry(0.01, 0.01, pi));
  CHECK(grazing.base / plain.slope == Approx(1.0).epsilon(0.06));
  CHECK(grazing.base + grazing.slope == Approx(plain.slope).epsilon(1e-12));
}

TEST_CASE("renderer: an unknown model is answered with the nearest name") {
  const auto renderer = make_builtin_renderer();
  CHECK_THROWS_WITH(find_model(*renderer, "mitsuba/gxx"), Catch::Contains("did you mean mitsuba/ggx?"));
}

TEST_CASE("renderer: parameters out of range, unknown or missing are refused by name") {
  const auto renderer = make_builtin_renderer();
  const Scene scene{8, 1, {}};
  const auto render = [&](const Material& material) { return renderer->render(material, scene); };
  CHECK_THROWS_WITH(render({"mitsuba/ggx", {{"alpha", {2.0}}, {"f0", {0.5}}, {"diffuse", {0.0}}}}),
                    Catch::Contains("alpha = 2; expected 1e-04 to 1"));
  CHECK_THROWS_WITH(render({"mitsuba/ggx", {{"alpha", {0.2}}, {"fo", {0.5}}, {"diffuse", {0.0}}}}),
                    Catch::Contains("has no parameter fo; did you mean f0?"));
  CHECK_THROWS_WITH(render({"mitsuba/ggx", {{"alpha", {0.2}}, {"diffuse", {0.0}}}}),
                    Catch::Contains("f0 is missing"));
  const Material good{"mitsuba/ggx", {{"alpha", {0.2}}, {"f0", {0.5}}, {"diffuse", {0.0}}}};
  CHECK_THROWS_WITH(renderer->render(good, {0, 1, {}}), Catch::Contains("resolution"));
  CHECK_THROWS_WITH(renderer->render(good, {8, 1, {0.0, 0.5}}), Catch::Contains("light distance"));
}
