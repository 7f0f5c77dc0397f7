// This file compares the built-in renderer with closed forms at single pixels, and checks the properties of
// its models.
#include "renderer/renderer.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "look/brdf.hpp"
#include "remap/error.hpp"
#include "renderer/fresnel.hpp"

using namespace remap;
using std::numbers::pi;

namespace {

// Returns the radiance of the pixel that looks along the normal under a headlight at distance 2, where all
// cosines are 1.
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

// Returns the fraction of light from `cos_light` that is reflected at specular 1, by the midpoint rule over
// the hemisphere.
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

// A PixelGeometry holds the directions at one pixel away from the middle of the sphere, computed from
// vectors.
struct PixelGeometry {
  double cos_light, cos_view, cos_half, cos_light_half, distance_2;
};

constexpr int kSide = 65, kRow = 25, kColumn = 44;
constexpr double kLightAngle = 50.0;

PixelGeometry pixel_geometry() {
  Vector3 n{};
  REQUIRE(sphere_point(kSide, kColumn + 0.5, kRow + 0.5, &n));
  const double angle = kLightAngle * pi / 180.0;
  double l[3] = {3.0 * std::sin(angle) - n.x, -n.y, 3.0 * std::cos(angle) - n.z};
  double v[3] = {-n.x, -n.y, 3.0 - n.z};
  const double light_length = std::hypot(l[0], l[1], l[2]), view_length = std::hypot(v[0], v[1], v[2]);
  double h[3];
  for (int i = 0; i < 3; ++i) {
    l[i] /= light_length;
    v[i] /= view_length;
    h[i] = l[i] + v[i];
  }
  const double half_length = std::hypot(h[0], h[1], h[2]);
  const auto dot = [](const double* a, double x, double y, double z) {
    return a[0] * x + a[1] * y + a[2] * z;
  };
  return {dot(l, n.x, n.y, n.z), dot(v, n.x, n.y, n.z), dot(h, n.x, n.y, n.z) / half_length,
          dot(h, l[0], l[1], l[2]) / half_length, light_length * light_length};
}

// Returns D G / (4 cos cos) as printed by Walter et al. 2007, in angles.
double walter(const std::string& name, double alpha, const PixelGeometry& g) {
  const double theta_h = std::acos(g.cos_half), tan_h = std::tan(theta_h);
  const auto shadowing = [&](double cosine) {
    const double tangent = std::tan(std::acos(cosine)), a = 1.0 / (alpha * tangent);
    if (name == "ggx") return 2.0 / (1.0 + std::sqrt(1.0 + std::pow(alpha * tangent, 2)));
    return a >= 1.6 ? 1.0 : (3.535 * a + 2.181 * a * a) / (1.0 + 2.276 * a + 2.577 * a * a);
  };
  double d = 0.0;
  if (name == "ggx")
    d = alpha * alpha / (pi * std::pow(g.cos_half, 4) * std::pow(alpha * alpha + tan_h * tan_h, 2));
  else if (name == "beckmann")
    d = std::exp(-std::pow(tan_h / alpha, 2)) / (pi * alpha * alpha * std::pow(g.cos_half, 4));
  else
    d = 1.0 / (pi * alpha * alpha) * std::pow(g.cos_half, 2.0 / (alpha * alpha) - 2.0);
  return d * shadowing(g.cos_light) * shadowing(g.cos_view) / (4.0 * g.cos_light * g.cos_view);
}

double pixel_of(const Material& material) {
  const auto renderer = make_builtin_renderer();
  return renderer->render(material, {kSide, 1, {kLightAngle, 3.0}}).values[kRow * kSide + kColumn];
}

}  // namespace

TEST_CASE("renderer: off the middle, microfacet models have Walter's closed forms with every Fresnel") {
  const PixelGeometry g = pixel_geometry();
  for (const std::string name : {"ggx", "beckmann", "as"})
    for (const double alpha : {0.12, 0.4, 0.9}) {
      const double shape = walter(name, alpha, g) * g.cos_light / g.distance_2;
      const double weight = std::pow(1.0 - g.cos_light_half, 5);
      const std::string model = "mitsuba/" + name;
      const auto pixel = [&](const std::string& kind, std::map<std::string, std::vector<double>> values) {
        values["alpha"] = {alpha};
        values["diffuse"] = {0.0};
        return pixel_of({model + kind, values});
      };
      CHECK(pixel("-plain", {{"specular", {0.7}}}) == Approx(0.7 * shape).epsilon(1e-6));
      CHECK(pixel("", {{"f0", {0.2}}}) == Approx((0.2 + 0.8 * weight) * shape).epsilon(1e-6));
      CHECK(pixel("-ior", {{"ior", {1.5}}}) == Approx((0.04 + 0.96 * weight) * shape).epsilon(1e-6));
      CHECK(pixel("-dielectric", {{"ior", {1.5}}}) ==
            Approx(fresnel_dielectric(g.cos_light_half, 1.5).mean() * shape).epsilon(1e-6));
      CHECK(pixel("-conductor", {{"eta", {0.2}}, {"k", {3.1}}}) ==
            Approx(fresnel_conductor(g.cos_light_half, 0.2, 3.1).mean() * shape).epsilon(1e-6));
      CHECK(pixel("-conductor", {{"eta", {1.5}}, {"k", {0.0}}}) ==
            Approx(pixel("-dielectric", {{"ior", {1.5}}})).epsilon(1e-6));
    }
}

TEST_CASE("renderer: off the middle, Ward and Phong have their closed forms") {
  const PixelGeometry g = pixel_geometry();
  const double alpha = 0.4, scale = 0.6 * g.cos_light / g.distance_2;
  const double lobe =
      std::exp(-std::pow(std::tan(std::acos(g.cos_half)) / alpha, 2)) / (4 * pi * alpha * alpha);
  const auto pixel = [&](const std::string& model) {
    return pixel_of({model, {{"alpha", {alpha}}, {"specular", {0.6}}, {"diffuse", {0.0}}}});
  };
  CHECK(pixel("mitsuba/ward") == Approx(scale * lobe / std::sqrt(g.cos_light * g.cos_view)).epsilon(1e-6));
  CHECK(pixel("mitsuba/ward-duer") == Approx(scale * lobe / (g.cos_light * g.cos_view)).epsilon(1e-6));
  // |light + view|^2 = 4 cos^2 of half the angle between them.
  const double half_2 = 4.0 * g.cos_light_half * g.cos_light_half;
  CHECK(pixel("mitsuba/ward-balanced") ==
        Approx(scale * 4.0 * lobe / (half_2 * std::pow(g.cos_half, 4))).epsilon(1e-6));
}

TEST_CASE("renderer: the conserving Ward equals Ward up to specular 1 and is constant beyond") {
  const auto pixel = [&](const std::string& model, double specular) {
    return pixel_of({model, {{"alpha", {0.4}}, {"specular", {specular}}, {"diffuse", {0.2}}}});
  };
  for (const double specular : {0.0, 0.3, 1.0})
    CHECK(pixel("mitsuba/ward-conserving", specular) == pixel("mitsuba/ward", specular));
  for (const double specular : {1.0001, 1.5, 2.0})
    CHECK(pixel("mitsuba/ward-conserving", specular) == pixel("mitsuba/ward", 1.0));
}

TEST_CASE("renderer: conductors take an index and an extinction for each channel, and cannot be swept") {
  const auto renderer = make_builtin_renderer();
  const Scene scene{24, 1, {30.0, 3.0}};
  const double eta[] = {0.2, 0.9, 1.4}, k[] = {3.9, 2.4, 1.6};
  const auto picture = [&](std::vector<double> index, std::vector<double> extinction) {
    return renderer->render(
        {"mitsuba/as-conductor", {{"alpha", {0.3}}, {"eta", index}, {"k", extinction}, {"diffuse", {0.0}}}},
        scene);
  };
  const Image rgb = picture({eta[0], eta[1], eta[2]}, {k[0], k[1], k[2]});
  REQUIRE(rgb.channels == 3);
  for (std::size_t c = 0; c < 3; ++c) {
    const Image grey = picture({eta[c]}, {k[c]});
    for (std::size_t i = 0; i < grey.values.size(); ++i) REQUIRE(rgb.values[3 * i + c] == grey.values[i]);
  }
  CHECK_THROWS_WITH(grey_material(renderer->model("mitsuba/as-conductor"), 0.3, 0.5, 0.0),
                    Catch::Contains("has no parameter for specular"));
}

TEST_CASE(
    "brdf: with exact Fresnel microfacet models reflect no more than they receive, and less than white") {
  for (const Brdf brdf : {Brdf::kBeckmann, Brdf::kGgx, Brdf::kAs})
    for (const double cos_light : {0.95, 0.3}) {
      constexpr int kSteps = 200;
      double white = 0.0, silver = 0.0, glass = 0.0;
      for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
          const double theta = (i + 0.5) * 0.5 * pi / kSteps;
          const LocalGeometry g = geometry(cos_light, std::cos(theta), (j + 0.5) * pi / kSteps);
          const double share = evaluate_shape(brdf, 0.4, g) * std::cos(theta) * std::sin(theta) *
                               (0.5 * pi / kSteps) * (2.0 * pi / kSteps);
          white += share;
          silver += share * fresnel_conductor(g.cos_light_half, 0.05, 3.6).mean();
          glass += share * fresnel_dielectric(g.cos_light_half, 1.5).mean();
        }
      CHECK(white <= 1.0 + 1e-3);
      CHECK(silver < white);
      CHECK(silver > 0.9 * white);
      CHECK(glass < 0.5 * white);
    }
}

TEST_CASE("renderer: radiance along the normal has the closed form of each model") {
  for (const double alpha : {0.1, 0.35, 0.8}) {
    const double a2 = alpha * alpha;
    const double exponent = 2.0 / a2 - 2.0;
    // Lambert's pixel is brdf * cos / distance^2, with specular 0.5 and distance 2.
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
  // With the light at 60 degrees, its direction at the pole follows from the triangle of origin, pole and
  // light.
  const Image side = renderer->render(material, {33, 1, {60.0, 3.0}});
  const double dx = 3.0 * std::sin(pi / 3), dz = 3.0 * std::cos(pi / 3) - 1.0;
  const double distance_2 = dx * dx + dz * dz;
  CHECK(side.values[16 * 33 + 16] == Approx(0.8 / pi * dz / std::sqrt(distance_2) / distance_2));
}

TEST_CASE("renderer: color makes three channels, each equal to the grey picture of its value") {
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

// This holds for all models of the hub. It also holds for Mitsuba's Phong: without division by the cosine of
// the light, cos^n of the mirrored angle is symmetric.
TEST_CASE("brdf: light and view can change places") {
  for (const Brdf brdf : kAllBrdfs) {
    const Lobe there = evaluate_lobe(brdf, Fresnel::kSchlick, 0.4, geometry(0.9, 0.35, 1.1));
    const Lobe back = evaluate_lobe(brdf, Fresnel::kSchlick, 0.4, geometry(0.35, 0.9, 1.1));
    CHECK(there.base == Approx(back.base).epsilon(1e-12));
    CHECK(there.slope == Approx(back.slope).epsilon(1e-12));
  }
}

TEST_CASE("brdf: energy-conserving models never reflect more than they receive") {
  for (const Brdf brdf : {Brdf::kBeckmann, Brdf::kGgx, Brdf::kAs, Brdf::kWardBalanced})
    for (const double alpha : {0.2, 0.5, 1.0})
      for (const double cos_light : {0.99, 0.6, 0.2})
        CHECK(directional_albedo(brdf, Fresnel::kNone, alpha, cos_light, 1.0) <= 1.0 + 1e-3);
}

TEST_CASE("renderer: parameters out of range, unknown or missing are refused by name") {
  const auto renderer = make_builtin_renderer();
  const Scene scene{8, 1, {}};
  const auto render = [&](const Material& material) { return renderer->render(material, scene); };
  CHECK_THROWS_WITH(render({"mitsuba/ggx", {{"alpha", {2.0}}, {"f0", {0.5}}, {"diffuse", {0.0}}}}),
                    Catch::Contains("alpha = 2 is out of range (1e-04 to 1)"));
  CHECK_THROWS_WITH(render({"mitsuba/ggx", {{"alpha", {0.2}}, {"fo", {0.5}}, {"diffuse", {0.0}}}}),
                    Catch::Contains("has no parameter fo (choose alpha, f0, diffuse)"));
  CHECK_THROWS_WITH(render({"mitsuba/ggx", {{"alpha", {0.2}}, {"diffuse", {0.0}}}}),
                    Catch::Contains("f0 has no value"));
  const Material good{"mitsuba/ggx", {{"alpha", {0.2}}, {"f0", {0.5}}, {"diffuse", {0.0}}}};
  CHECK_THROWS_WITH(renderer->render(good, {0, 1, {}}), Catch::Contains("resolution"));
  CHECK_THROWS_WITH(renderer->render(good, {8, 1, {0.0, 0.5}}), Catch::Contains("light distance"));
}

TEST_CASE("Lobes of an exponent are what their sources print", "[renderer]") {
  const PixelGeometry g = pixel_geometry();
  const double irradiance = g.cos_light / g.distance_2;
  // The mirrored light is 2 (N.L) N - L. Its cosine to the camera follows from the cosine between light and
  // camera.
  const double cos_between = 2.0 * g.cos_light_half * g.cos_light_half - 1.0,
               cos_mirror = 2.0 * g.cos_light * g.cos_view - cos_between;
  constexpr double kKs = 0.7, kKd = 0.3;
  for (const double n : {0.1, 5.0, 96.08, 10000.0}) {
    CAPTURE(n);
    const auto pixel = [&](const char* name) {
      return pixel_of({name, {{"exponent", {n}}, {"specular", {kKs}}, {"diffuse", {kKd}}}});
    };
    // OpenGL 1.0, section 2.13, computes light times (Kd N.L + Ks (N.H)^n). Here, the light gives a white
    // diffuse surface radiance 1.
    const double light = 1.0 / (pi * g.distance_2);
    CHECK(pixel("legacy/blinn-phong") ==
          Approx(light * (kKd * g.cos_light + kKs * std::pow(g.cos_half, n))).epsilon(1e-6));
    CHECK(pixel("legacy/phong") ==
          Approx(light * (kKd * g.cos_light + kKs * std::pow(cos_mirror, n))).epsilon(1e-6));
    CHECK(pixel("legacy/blinn-phong-normalised") ==
          Approx(irradiance * (kKd / pi + kKs * (n + 8.0) / (8.0 * pi) * std::pow(g.cos_half, n)))
              .epsilon(1e-6));
    CHECK(pixel("legacy/phong-normalised") ==
          Approx(irradiance * (kKd / pi + kKs * (n + 2.0) / (2.0 * pi) * std::pow(cos_mirror, n)))
              .epsilon(1e-6));
  }
  CHECK_THROWS_WITH(
      pixel_of({"legacy/phong", {{"exponent", {0.05}}, {"specular", {1.0}}, {"diffuse", {0.0}}}}),
      Catch::Matchers::Contains("out of range"));
}
