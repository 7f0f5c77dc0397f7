// This file tests spheres under environments: the maps, their light, and the study that uses them.
#include "look/environment.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>

#include "core/files.hpp"
#include "look/brdf.hpp"
#include "look/image.hpp"
#include "look/lit_sphere.hpp"
#include "look/scene.hpp"
#include "lower/fit_file.hpp"
#include "lower/interpreter.hpp"
#include "remap/error.hpp"
#include "study/environments.hpp"
#include "support/skip.hpp"
#include "support/temporary_folder.hpp"

using namespace remap;
using std::numbers::pi;

namespace {

Environment constant_environment(float radiance) {
  return {"constant", {8, 4, 3, std::vector<float>(8 * 4 * 3, radiance)}};
}

// Returns an environment whose only light comes from a cap of 10 degrees around a direction.
Environment cap_environment(const Vector3& middle) {
  Environment environment{"cap", {128, 64, 3, {}}};
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 128; ++column) {
      const Vector3 w = map_direction({(column + 0.5) / 128.0, (row + 0.5) / 64.0});
      const bool lit = w.x * middle.x + w.y * middle.y + w.z * middle.z > std::cos(10.0 * pi / 180.0);
      environment.map.values.insert(environment.map.values.end(), 3, lit ? 1.0f : 0.0f);
    }
  return environment;
}

SpherePictures render(const Environment& environment, const SphereMaterial& material, int resolution,
                      int samples, bool shares_directions = false) {
  const RadiancePyramid pyramid({&environment, 1}, 64);
  SphereSampling sampling;
  sampling.resolution = resolution;
  sampling.samples = samples;
  sampling.shares_directions = shares_directions;
  return render_spheres(pyramid, {&material, 1}, sampling);
}

// Returns the mean difference of the pixels in a row from the mean of their neighbours.
double roughness_of(const SpherePictures& pictures) {
  const std::vector<float> radiance = pictures.radiance(0, 0);
  const std::vector<std::uint32_t>& pixels = pictures.pixels();
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 1; i + 1 < pixels.size(); ++i)
    if (pixels[i + 1] - pixels[i - 1] == 2) {
      sum += std::fabs(static_cast<double>(radiance[3 * i]) -
                       0.5 * static_cast<double>(radiance[3 * i - 3] + radiance[3 * i + 3]));
      ++count;
    }
  return sum / static_cast<double>(count);
}

// A Centroid is the centre of the light in the picture, in pixels to the right of and above its middle.
struct Centroid {
  double right, up;
};
Centroid centroid(const SpherePictures& pictures) {
  const std::vector<float> radiance = pictures.radiance(0, 0);
  const double middle = 0.5 * (pictures.resolution() - 1);
  double sum = 0.0, right = 0.0, up = 0.0;
  for (std::size_t i = 0; i < pictures.pixels().size(); ++i) {
    const auto side = static_cast<std::uint32_t>(pictures.resolution());
    const double value = static_cast<double>(radiance[3 * i]);
    sum += value;
    right += value * (pictures.pixels()[i] % side - middle);
    up += value * (middle - pictures.pixels()[i] / side);
  }
  return {right / sum, up / sum};
}

// Returns the fraction of uniform light that is reflected, seen from `cos_view`. It uses the midpoint rule
// over half vectors. The substitution tan(theta_half) = alpha * t / (1 - t) resolves narrow lobes.
double directional_albedo(const SphereMaterial& material, double cos_view) {
  const double sin_view = std::sqrt(1.0 - cos_view * cos_view);
  constexpr int kSteps = 1500, kTurns = 400;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) / kSteps;
    const double tangent = material.alpha * t / (1.0 - t);
    const double cos_half = 1.0 / std::sqrt(1.0 + tangent * tangent), sin_half = tangent * cos_half;
    // This uses d(theta) = cos^2(theta) d(tan theta).
    const double step = cos_half * cos_half * material.alpha / ((1.0 - t) * (1.0 - t)) / kSteps;
    for (int j = 0; j < kTurns; ++j) {
      const double turn = 2.0 * pi * (j + 0.5) / kTurns;
      const double cos_view_half = sin_view * sin_half * std::cos(turn) + cos_view * cos_half;
      const double cos_light = 2.0 * cos_view_half * cos_half - cos_view;
      if (cos_view_half <= 0.0 || cos_light <= 0.0) continue;
      const double between = 2.0 * cos_view_half * cos_view_half - 1.0;
      const Lobe lobe = evaluate_lobe(material.model.brdf, material.model.fresnel, material.alpha,
                                      {cos_light, cos_view, cos_half, cos_view_half, 2.0 + 2.0 * between,
                                       2.0 * cos_light * cos_view - between});
      // This uses d(light) = 4 cos(view, half) d(half).
      sum += (lobe.base + material.specular * lobe.slope) * cos_light * 4.0 * cos_view_half * sin_half *
             step * 2.0 * pi / kTurns;
    }
  }
  return sum;
}

std::vector<EnvironmentComparison> comparisons_of(const std::vector<EnvironmentComparison>& result,
                                                  Method method) {
  std::vector<EnvironmentComparison> chosen;
  for (const EnvironmentComparison& comparison : result)
    if (comparison.conversion.method == method) chosen.push_back(comparison);
  return chosen;
}

// Returns means over the comparisons of one method. `energy` is the mean of the absolute values.
EnvironmentComparison means_of(const std::vector<EnvironmentComparison>& result, Method method) {
  EnvironmentComparison mean;
  const std::vector<EnvironmentComparison> chosen = comparisons_of(result, method);
  for (const EnvironmentComparison& comparison : chosen) {
    mean.rmse += comparison.rmse / static_cast<double>(chosen.size());
    mean.ssim += comparison.ssim / static_cast<double>(chosen.size());
    mean.energy += std::fabs(comparison.energy) / static_cast<double>(chosen.size());
  }
  return mean;
}

EnvironmentsOptions small_study() {
  EnvironmentsOptions options;
  options.pairs = {{"mitsuba/beckmann", "mitsuba/ggx"}};
  options.alphas = {0.1, 0.4};
  options.environments = builtin_environments(64);
  options.resolution = 24;
  options.samples = 64;
  options.match_resolution = 64;
  return options;
}

}  // namespace

TEST_CASE("environment: the middle of a map lies behind the sphere, its right half on the right") {
  const auto check = [](const Vector3& direction, double u, double v) {
    const MapPosition position = map_position(direction);
    CHECK(position.u == Approx(u).margin(1e-12));
    CHECK(position.v == Approx(v).margin(1e-12));
  };
  check({0.0, 0.0, -1.0}, 0.5, 0.5);
  check({1.0, 0.0, 0.0}, 0.75, 0.5);
  check({-1.0, 0.0, 0.0}, 0.25, 0.5);
  CHECK(map_position({0.0, 1.0, 0.0}).v == Approx(0.0).margin(1e-12));
  CHECK(map_position({0.0, -1.0, 0.0}).v == Approx(1.0).epsilon(1e-12));
  for (const MapPosition given : {MapPosition{0.1, 0.2}, MapPosition{0.6, 0.7}, MapPosition{0.95, 0.5}}) {
    const MapPosition back = map_position(map_direction(given));
    CHECK(back.u == Approx(given.u).epsilon(1e-12));
    CHECK(back.v == Approx(given.v).epsilon(1e-12));
  }
}

TEST_CASE("lit sphere: light is reflected where a mirror ball reflects it") {
  const SphereMaterial shiny{builtin_brdf("mitsuba/beckmann-plain"), 0.05, 1.0};
  const auto shown = [&](const Vector3& light) {
    return centroid(render(cap_environment(light), shiny, 33, 256));
  };
  const Centroid behind_camera = shown({0.0, 0.0, 1.0});
  CHECK(std::hypot(behind_camera.right, behind_camera.up) < 0.1);
  // A surface reflects light from the side if its normal halves the angle to the camera. This is at 37.3
  // degrees from the axis, or 0.777 of the picture's half width.
  const Centroid right = shown({1.0, 0.0, 0.0});
  CHECK(right.right == Approx(0.777 * 16.5).epsilon(0.03));
  CHECK(std::fabs(right.up) < 0.1);
  const Centroid above = shown({0.0, 1.0, 0.0});
  CHECK(above.up == Approx(right.right).epsilon(0.02));
  CHECK(std::fabs(above.right) < 0.1);
}

TEST_CASE("lit sphere: under uniform light it shows the directional albedo", "[slow]") {
  const Environment even = constant_environment(2.0f);
  for (const std::string name : {"mitsuba/ward", "mitsuba/ward-balanced", "mitsuba/beckmann", "mitsuba/ggx",
                                 "mitsuba/as", "mitsuba/phong"})
    for (const double alpha : {0.1, 0.6}) {
      const SphereMaterial material{builtin_brdf(name), alpha, 0.5};
      const SpherePictures pictures = render(even, material, 8, 16384);
      const std::vector<float> cosines = view_cosines(8, 1);
      const std::vector<float> radiance = pictures.radiance(0, 0);
      for (const std::size_t i : {std::size_t{2}, pictures.pixels().size() / 2}) {
        INFO(name << ", alpha " << alpha << ", pixel " << i);
        const double expected =
            2.0 * directional_albedo(material, static_cast<double>(cosines[pictures.pixels()[i]]));
        CHECK(radiance[3 * i] == Approx(expected).epsilon(0.002));
      }
    }
}

TEST_CASE("lit sphere: microfacets without absorption reflect at most the light that they receive",
          "[slow]") {
  const Environment even = constant_environment(1.0f);
  // In Mitsuba, Ashikhmin-Shirley's distribution has Beckmann's shadowing, which reflects 6 % too much at the
  // rim.
  for (const std::string name : {"mitsuba/beckmann", "mitsuba/ggx"})
    for (const double alpha : {0.1, 0.4, 1.0}) {
      const SpherePictures pictures = render(even, {builtin_brdf(name), alpha, 1.0}, 24, 1024);
      for (const float value : pictures.radiance(0, 0)) CHECK(value <= 1.005f);
    }
}

TEST_CASE("lit sphere: more directions leave less noise") {
  const Environment sky = builtin_environments(64).front();
  const auto noise = [&](int samples) {
    const SpherePictures pictures = render(sky, {builtin_brdf("mitsuba/ggx"), 0.3, 0.5}, 16, samples);
    const std::vector<float> a = pictures.half_radiance(0, 0, 0), b = pictures.half_radiance(0, 0, 1);
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(static_cast<double>(a[i] - b[i]), 2);
    return std::sqrt(sum / static_cast<double>(a.size()));
  };
  CHECK(noise(2048) < 0.5 * noise(64));
}

TEST_CASE("radiance pyramid: a map of any size keeps its light at every level") {
  Environment odd{"odd", {30, 15, 3, {}}};
  for (int i = 0; i < 30 * 15; ++i)
    for (int c = 0; c < 3; ++c)
      odd.map.values.push_back(i == 200 ? 100.0f : static_cast<float>((i * 7 + c) % 10));
  const RadiancePyramid pyramid({&odd, 1}, 32);
  CHECK_FALSE(pyramid.lamps(0).empty());
  float radiance[3];
  // Compares the mean over all directions, by the midpoint rule. Bilinear lookup moves a little light at the
  // poles.
  for (const double solid_angle : {1e-6, 0.05, 0.3}) {
    double sum = 0.0, weights = 0.0;
    for (int row = 0; row < 128; ++row)
      for (int column = 0; column < 256; ++column) {
        const double v = (row + 0.5) / 128.0;
        pyramid.look_up(map_direction({(column + 0.5) / 256.0, v}), solid_angle, radiance);
        const double values = 0.2126 * radiance[0] + 0.7152 * radiance[1] + 0.0722 * radiance[2];
        sum += std::sin(pi * v) * values, weights += std::sin(pi * v);
      }
    for (const Lamp& lamp : pyramid.lamps(0))
      sum += weights * (0.2126 * lamp.flux[0] + 0.7152 * lamp.flux[1] + 0.0722 * lamp.flux[2]) / (4.0 * pi);
    CHECK(sum / weights == Approx(mean_luminance(odd)).epsilon(0.01));
  }
  const Environment even = constant_environment(3.0f);
  for (const double solid_angle : {1e-6, 0.01, 1.0, 100.0}) {
    RadiancePyramid({&even, 1}, 8).look_up({0.6, 0.8, 0.0}, solid_angle, radiance);
    CHECK(radiance[1] == Approx(3.0).epsilon(1e-6));
  }
}

TEST_CASE("environment: an EXR file is read as it was written, grey as three channels") {
  const TemporaryFolder folder;
  Image image{4, 2, 3, {}};
  for (int i = 0; i < 24; ++i) image.values.push_back(static_cast<float>(i));
  write_exr(folder.path() / "map.exr", image, {});
  const Environment environment = load_environment(folder.path() / "map.exr");
  CHECK(environment.name == "map");
  CHECK(environment.map.values == image.values);

  Image grey{4, 2, 1, std::vector<float>(8, 0.5f)};
  grey.values[3] = -1.0f;
  write_exr(folder.path() / "grey.exr", grey, {});
  const Environment from_grey = load_environment(folder.path() / "grey.exr");
  CHECK(from_grey.map.values.size() == 24);
  CHECK(from_grey.map.values[0] == 0.5f);
  CHECK(from_grey.map.values[10] == 0.0f);  // clamped to 0
}

TEST_CASE("environment: files that do not hold a map are refused") {
  const TemporaryFolder folder;
  const auto written = [&](const Image& image) {
    write_exr(folder.path() / "bad.exr", image, {});
    return folder.path() / "bad.exr";
  };
  CHECK_THROWS_WITH(load_environment(folder.path() / "none.exr"),
                    Catch::Contains("none.exr: cannot be read"));
  CHECK_THROWS_WITH(load_environment(folder.path()), Catch::Contains("not a file"));
  CHECK_THROWS_WITH(load_environment(written({4, 4, 1, std::vector<float>(16, 1.0f)})),
                    Catch::Contains("size 4x4 does not fit a map in latitude and longitude"));
  CHECK_THROWS_WITH(load_environment(written({4, 2, 1, std::vector<float>(8, 0.0f)})),
                    Catch::Contains("the map is black"));
  CHECK_THROWS_WITH(
      load_environment(written({4, 2, 1, std::vector<float>(8, std::numeric_limits<float>::infinity())})),
      Catch::Contains("not finite"));
  const auto cut = written({64, 32, 1, std::vector<float>(64 * 32, 1.0f)});
  std::filesystem::resize_file(cut, std::filesystem::file_size(cut) / 2);
  CHECK_THROWS_WITH(load_environment(cut), Catch::Contains("is damaged"));
  write_file(folder.path() / "text.exr", "no picture");
  CHECK_THROWS_AS(load_environment(folder.path() / "text.exr"), Error);
}

TEST_CASE("environment: maps of Blender are read", "[needs]") {
  const std::filesystem::path folder = "/usr/share/blender/datafiles/studiolights/world";
  if (!std::filesystem::is_directory(folder))
    return skip("blender-data", "Debian's blender-data is not installed");
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".exr") CHECK(mean_luminance(load_environment(entry.path())) > 0.0);
}

TEST_CASE("environment: the built-in ones are finite light, and the clear sky is brightest at its sun") {
  const std::vector<Environment> environments = builtin_environments(128);
  REQUIRE(environments.size() == 3);
  for (const Environment& environment : environments) {
    CHECK(environment.map.values.size() == 128 * 256 * 3);
    CHECK(mean_luminance(environment) > 0.05);
    for (const float value : environment.map.values) CHECK_FALSE(!(value >= 0.0f && value < 1e4f));
    CHECK(mean_luminance(exposed(environment, 3.0)) ==
          Approx(3.0 * mean_luminance(environment)).epsilon(1e-6));
  }
  const std::vector<float>& sky = environments[0].map.values;
  const auto brightest = static_cast<std::size_t>(std::max_element(sky.begin(), sky.end()) - sky.begin()) / 3;
  // The sun is 40 degrees above the horizon, and 120 degrees to the right of the middle.
  CHECK(static_cast<double>(brightest / 256) / 128.0 == Approx(0.5 - 40.0 / 180.0).margin(0.01));
  CHECK(static_cast<double>(brightest % 256) / 256.0 == Approx(0.5 + 120.0 / 360.0).margin(0.01));
}

TEST_CASE("study environments: a model copied to itself gives equal pictures") {
  EnvironmentsOptions options = small_study();
  options.pairs = {{"mitsuba/ggx", "mitsuba/ggx"}};
  const auto result = study_environments(options);
  // There are 2 alphas and 3 environments, copied numbers and three objectives.
  REQUIRE(result.size() == 24);
  const EnvironmentComparison copy = means_of(result, Method::kCopy);
  CHECK(copy.rmse == 0.0);
  CHECK(copy.ssim == Approx(1.0).epsilon(1e-6));
  CHECK(copy.energy == 0.0);
  // A match of a model with itself finds its alpha to 2e-7.
  CHECK(means_of(result, Method::kNatural2).rmse < 1e-3);
  CHECK_THAT(environments_csv(options, result),
             Catch::Contains("# noise_percent: ") && !Catch::Contains("noise_percent: 0\n"));
  CHECK(comparisons_of(result, Method::kShipped).empty());  // there is no fit
}

TEST_CASE(
    "study environments: the objective natural looks more alike than copying, and no thread changes it") {
  EnvironmentsOptions options = small_study();
  const auto result = study_environments(options);
  const EnvironmentComparison copy = means_of(result, Method::kCopy);
  const EnvironmentComparison natural = means_of(result, Method::kNatural2);
  CHECK(natural.rmse < 0.8 * copy.rmse);
  CHECK(natural.ssim > copy.ssim);
  CHECK(natural.energy < copy.energy);
  const std::string csv = environments_csv(options, result);
  CHECK(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')) ==
        7 + result.size());  // comments and header
  options.jobs = 1;
  CHECK(environments_csv(options, study_environments(options)) == csv);
}

TEST_CASE("study environments: no method has less than the least error, and copies of a model reach it",
          "[slow]") {
  EnvironmentsOptions options = small_study();
  options.alphas = {0.3};
  options.resolution = 48;  // the resolution of the search
  options.samples = 256;
  options.least_error = true;
  const auto result = study_environments(options);
  const EnvironmentComparison best = means_of(result, Method::kBest);
  for (const Method method : {Method::kCopy, Method::kPaper, Method::kNatural1, Method::kNatural2})
    CHECK(best.rmse < means_of(result, method).rmse);

  options.pairs = {{"mitsuba/as", "mitsuba/as"}};
  const auto same = study_environments(options);
  const Conversion found = comparisons_of(same, Method::kBest).front().conversion;
  CHECK(found.target_alpha == Approx(0.3).epsilon(0.01));
  CHECK(found.target_specular == Approx(0.5).epsilon(0.01));
}

TEST_CASE("study environments: a fit is used as shipped") {
  EnvironmentsOptions options = small_study();
  options.pairs = {{"mitsuba/ward", "mitsuba/as"}};
  options.fits = {load_fit(REMAP_SOURCE_DIR "/fits/mitsuba_ward_to_mitsuba_as.json")};
  const auto result = study_environments(options);
  const auto shipped = comparisons_of(result, Method::kShipped);
  const auto natural = comparisons_of(result, Method::kNatural2);
  REQUIRE(shipped.size() == natural.size());
  for (const EnvironmentComparison& comparison : shipped) {
    const Conversion& conversion = comparison.conversion;
    const MappedTexel expected = evaluate_fit(options.fits[0], conversion.alpha, options.specular);
    CHECK(conversion.target_alpha == Approx(expected.alpha));
    CHECK(conversion.target_specular == Approx(expected.specular));
  }
  // The shipped fit was chosen by pictures under other lights. The objective's match uses a single light.
  CHECK(means_of(result, Method::kShipped).rmse < means_of(result, Method::kNatural2).rmse + 0.1);
}

TEST_CASE("study environments: invalid options are refused") {
  using Options = EnvironmentsOptions;
  const std::pair<std::function<void(Options&)>, const char*> faults[] = {
      {[](Options& o) {
         o.pairs = {{"mitsuba/gxx", "mitsuba/as"}};
       },
       "did you mean mitsuba/ggx?"},
      {[](Options& o) { o.alphas = {2.0}; }, "alpha: 2 is out of range"},
      {[](Options& o) { o.specular = 0.0; }, "specular: 0 is out of range"},
      {[](Options& o) { o.alphas.clear(); }, "at least one pair"},
      {[](Options& o) { o.environments.push_back(o.environments.front()); }, "two have the name 'sky'"},
      {[](Options& o) { o.samples = 1; }, "samples: 1 is out of range (16"},
      {[](Options& o) { o.resolution = 2; }, "resolution: 2 is out of range (4"}};
  for (const auto& [spoil, message] : faults) {
    Options options = small_study();
    spoil(options);
    CHECK_THROWS_WITH(study_environments(options), Catch::Contains(message));
  }
}

TEST_CASE("spheres: few directions that all pixels share give a picture as smooth as many") {
  const Environment studio = builtin_environments(64).back();
  REQUIRE(studio.name == "studio");
  const SphereMaterial material{{}, 0.3, 0.5, 0.0};
  const double fine = roughness_of(render(studio, material, 48, 4096));
  CHECK(roughness_of(render(studio, material, 48, 64)) > 2.0 * fine);
  CHECK(roughness_of(render(studio, material, 48, 64, true)) < 1.5 * fine);
}
