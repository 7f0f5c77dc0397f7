#include "study/lit_reflectances.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "lights/display_curve.hpp"
#include "look/image.hpp"
#include "renderer/renderer.hpp"
#include "study/golden_section.hpp"

namespace remap {
namespace {

constexpr BrdfModel kLobe{Brdf::kGgx, Fresnel::kSchlick};
constexpr BrdfModel kNoLobe{Brdf::kGgx, Fresnel::kNone};  // black at specular 0

std::vector<float> difference(const std::vector<float>& a, const std::vector<float>& b) {
  std::vector<float> values(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) values[i] = a[i] - b[i];
  return values;
}

// Returns RGB values of `pixels` in grey pictures of the built-in renderer with the light at the camera.
BasisPictures headlight_basis(double alpha, int resolution, const std::vector<std::uint32_t>& pixels) {
  // A light at distance d gives the closest point of a white diffuse sphere the radiance 1 / (pi (d - 1)^2).
  constexpr double kNearest = 2.0, kExposure = std::numbers::pi * kNearest * kNearest;
  const auto renderer = make_builtin_renderer();
  Scene scene;
  scene.resolution = resolution;
  scene.light = {0.0, 1.0 + kNearest};
  const auto picture = [&](double f0, double diffuse) {
    const Image image =
        renderer->render({"mitsuba/ggx", {{"alpha", {alpha}}, {"f0", {f0}}, {"diffuse", {diffuse}}}}, scene);
    std::vector<float> values;
    values.reserve(3 * pixels.size());
    for (const std::uint32_t pixel : pixels)
      values.insert(values.end(), 3,
                    static_cast<float>(
                        kExposure *
                        static_cast<double>(image.values[pixel * static_cast<std::size_t>(image.channels)])));
    return values;
  };
  const std::vector<float> dark = picture(0.0, 0.0);
  return {difference(picture(0.0, 1.0), dark), dark, difference(picture(1.0, 0.0), dark)};
}

constexpr std::size_t kPixelStep = 4;
constexpr std::size_t kGrid = 33;
constexpr int kSections = 14, kNewtonSteps = 4;

class MetallicSearch {
 public:
  MetallicSearch(const LitReflectances& lit, std::size_t alpha, const Reflectances& source,
                 const MetallicReflection& reflection)
      : reflection_(reflection), guess_(source.diffuse) {
    for (std::size_t c = 0; c < 3; ++c) guess_[c] = std::clamp(source.diffuse[c] + source.f0[c], 0.0, 1.0);
    for (std::size_t light = 0; light < lit.environment_count(); ++light) {
      const BasisPictures& basis = lit.basis(alpha, light);
      for (std::size_t c = 0; c < 3; ++c) {
        BasisPictures strip;
        std::vector<float> shown;
        for (std::size_t i = c; i < basis.dark.size(); i += 3 * kPixelStep) {
          strip.diffuse.push_back(basis.diffuse[i]);
          strip.dark.push_back(basis.dark[i]);
          strip.slope.push_back(basis.slope[i]);
          shown.push_back(display_curve()(static_cast<float>(source.diffuse[c]) * basis.diffuse[i] +
                                          basis.dark[i] + static_cast<float>(source.f0[c]) * basis.slope[i])
                              .first);
        }
        strips_.push_back(std::move(strip));
        sources_.push_back(std::move(shown));
      }
    }
  }

  MetallicSurface best() {
    MetallicSurface best;
    double least = error_at(0.0, guess_, &best);
    for (std::size_t i = 1; i < kGrid; ++i)
      least = std::min(least, error_at(static_cast<double>(i) / (kGrid - 1), guess_, &best));
    constexpr double kCell = 1.0 / (kGrid - 1);
    const Rgb start = best.base_color;
    golden_section(std::max(0.0, best.metallic - kCell), std::min(1.0, best.metallic + kCell), kSections,
                   [&](double metallic) { return error_at(metallic, start, &best); });
    return best;
  }

 private:
  // Returns the sum of squared errors over the pixels of a strip. Adds its derivatives to the sums for
  // Newton's method.
  double squared_error(std::size_t index, double metallic, double albedo, double* slope_sum,
                       double* bend_sum) const {
    const BasisPictures& strip = strips_[index];
    const std::vector<float>& source = sources_[index];
    const double n = 1.0 - metallic;
    const auto by_diffuse = static_cast<float>(reflection_.diffuse_of_albedo * n);
    const auto by_slope = static_cast<float>(metallic);
    const auto base = static_cast<float>(reflection_.dielectric_f0 * n), a = static_cast<float>(albedo);
    const DisplayCurve& curve = display_curve();
    double square = 0.0;
    for (std::size_t i = 0; i < source.size(); ++i) {
      const float growth = by_diffuse * strip.diffuse[i] + by_slope * strip.slope[i];
      const auto [value, slope] = curve(strip.dark[i] + base * strip.slope[i] + a * growth);
      const auto error = static_cast<double>(value - source[i]);
      const auto change = static_cast<double>(slope * growth);
      square += error * error;
      *slope_sum += error * change;
      *bend_sum += change * change;
    }
    return square;
  }

  // Returns the smallest mean RMSE at one metallic. If no earlier call found a smaller one, sets `best`. In
  // each step of Newton's method, the weight of a light is the inverse of its RMSE, because the objective is
  // a mean of roots.
  double error_at(double metallic, const Rgb& start, MetallicSurface* best) {
    Rgb albedo = start;
    double least = 1e300;
    const std::size_t lights = strips_.size() / 3;
    for (int step = 0; step <= kNewtonSteps; ++step) {
      double mean = 0.0;
      std::array<double, 3> slope{}, bend{};
      for (std::size_t light = 0; light < lights; ++light) {
        double square = 0.0;
        std::array<double, 3> light_slope{}, light_bend{};
        for (std::size_t c = 0; c < 3; ++c)
          square += squared_error(3 * light + c, metallic, albedo[c], &light_slope[c], &light_bend[c]);
        const double count = 3.0 * static_cast<double>(sources_[3 * light].size());
        const double rmse = std::sqrt(square / count);
        mean += rmse / static_cast<double>(lights);
        for (std::size_t c = 0; c < 3; ++c) {
          slope[c] += light_slope[c] / (rmse + 1e-6);
          bend[c] += light_bend[c] / (rmse + 1e-6);
        }
      }
      if (mean < least_) {
        least_ = mean;
        *best = {albedo, metallic};
      }
      least = std::min(least, mean);
      for (std::size_t c = 0; c < 3; ++c)
        if (bend[c] > 0.0) albedo[c] = std::clamp(albedo[c] - slope[c] / bend[c], 0.0, 1.0);
    }
    return least;
  }

  MetallicReflection reflection_;
  Rgb guess_;
  // These are pictures at the compared pixels, of three channels for each light. The source's have display
  // values.
  std::vector<BasisPictures> strips_;
  std::vector<std::vector<float>> sources_;
  double least_ = 1e300;
};

}  // namespace

LitReflectances::LitReflectances(std::span<const Environment> environments, std::span<const double> alphas,
                                 const SphereSampling& sampling)
    : environment_count_(environments.size()), resolution_(sampling.resolution) {
  const RadiancePyramid pyramid(environments);
  for (const double alpha : alphas) {
    const std::array materials = {SphereMaterial{kNoLobe, alpha, 0.0, 1.0}, SphereMaterial{kLobe, alpha, 0.0},
                                  SphereMaterial{kLobe, alpha, 1.0}};
    const SpherePictures pictures = render_spheres(pyramid, materials, sampling);
    pixels_ = pictures.pixels();
    for (std::size_t e = 0; e < environment_count_; ++e) {
      std::vector<float> dark = pictures.radiance(1, e);
      std::vector<float> slope = difference(pictures.radiance(2, e), dark);
      bases_.push_back({pictures.radiance(0, e), std::move(dark), std::move(slope)});
    }
    bases_.push_back(headlight_basis(alpha, resolution_, pixels_));
  }
}

std::vector<float> LitReflectances::radiance(std::size_t alpha, std::size_t light,
                                             const Reflectances& surface) const {
  const BasisPictures& from = basis(alpha, light);
  std::vector<float> values(from.dark.size());
  for (std::size_t c = 0; c < 3; ++c) {
    const auto diffuse = static_cast<float>(surface.diffuse[c]), f0 = static_cast<float>(surface.f0[c]);
    for (std::size_t i = c; i < values.size(); i += 3)
      values[i] = diffuse * from.diffuse[i] + from.dark[i] + f0 * from.slope[i];
  }
  return values;
}

Reflectances reflectances_of(const MetallicSurface& surface, const MetallicReflection& reflection) {
  Reflectances all;
  const double n = 1.0 - surface.metallic;
  for (std::size_t c = 0; c < 3; ++c) {
    all.diffuse[c] = reflection.diffuse_of_albedo * n * surface.base_color[c];
    all.f0[c] = reflection.dielectric_f0 * n + surface.metallic * surface.base_color[c];
  }
  return all;
}

MetallicSurface best_metallic(const LitReflectances& lit, std::size_t alpha, const Reflectances& source,
                              const MetallicReflection& reflection) {
  return MetallicSearch(lit, alpha, source, reflection).best();
}

}  // namespace remap
