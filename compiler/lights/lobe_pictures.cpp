#include "lights/lobe_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "look/brdf_models.hpp"
#include "renderer/renderer.hpp"

namespace remap {
namespace {

constexpr double kPointDistance = 3.0;
constexpr int kPointSamples = 8;  // along each side of a pixel, because highlights are narrower than pixels

}  // namespace

StudyLights::StudyLights(std::vector<Environment> environments, const SphereSampling& sampling,
                         std::vector<double> angles)
    : environments_(std::move(environments)), angles_(std::move(angles)), sampling_(sampling) {
  sampling_.progress = nullptr;
  const std::array materials = {SphereMaterial{{Brdf::kGgx, Fresnel::kNone}, 1.0, 0.0, 1.0}};
  const SpherePictures pictures = render_spheres(RadiancePyramid(environments_), materials, sampling_);
  pixels_ = pictures.pixels();
  for (std::size_t light = 0; light < environment_count(); ++light)
    diffuse_.push_back(pictures.radiance(0, light));
  for (std::size_t light = environment_count(); light < count(); ++light)
    diffuse_.push_back(point_lit(light, "mitsuba/ggx-plain", 1.0, 0.0, 1.0));
}

std::vector<float> StudyLights::point_lit(std::size_t light, const std::string& model, double alpha,
                                          double specular, double diffuse) const {
  static const std::unique_ptr<Renderer> renderer = make_builtin_renderer();
  Scene scene;
  scene.resolution = sampling_.resolution;
  scene.light = {angles_[light - environment_count()], kPointDistance};
  scene.samples_per_axis = kPointSamples;
  const double nearest = kPointDistance - 1.0, exposure = std::numbers::pi * nearest * nearest;
  const Image image =
      renderer->render(grey_material(renderer->model(model), alpha, specular, diffuse), scene);
  std::vector<float> values;
  values.reserve(3 * pixels_.size());
  for (const std::uint32_t pixel : pixels_)
    values.insert(
        values.end(), 3,
        static_cast<float>(
            exposure * static_cast<double>(image.values[pixel * static_cast<std::size_t>(image.channels)])));
  return values;
}

LobePictures::LobePictures(const StudyLights& lights, const std::string& model, std::vector<double> alphas)
    : alphas_(std::move(alphas)) {
  const RadiancePyramid pyramid(lights.environments());
  const BrdfModel brdf = builtin_brdf(model);
  const auto difference = [](std::vector<float> a, const std::vector<float>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
    return a;
  };
  for (const double alpha : alphas_) {
    const std::array materials = {SphereMaterial{brdf, alpha, 0.0, 0.0},
                                  SphereMaterial{brdf, alpha, 1.0, 0.0}};
    const SpherePictures pictures = render_spheres(pyramid, materials, lights.sampling());
    std::vector<std::vector<float>>& dark = dark_.emplace_back();
    std::vector<std::vector<float>>& slope = slope_.emplace_back();
    for (std::size_t light = 0; light < lights.environment_count(); ++light) {
      dark.push_back(pictures.radiance(0, light));
      slope.push_back(difference(pictures.radiance(1, light), dark.back()));
    }
    for (std::size_t light = lights.environment_count(); light < lights.count(); ++light) {
      dark.push_back(lights.point_lit(light, model, alpha, 0.0, 0.0));
      slope.push_back(difference(lights.point_lit(light, model, alpha, 1.0, 0.0), dark.back()));
    }
  }
}

void LobePictures::add(std::size_t light, double alpha, const Rgb& specular, bool is_constant,
                       std::vector<float>& radiance) const {
  const double clamped = std::clamp(alpha, alphas_.front(), alphas_.back());
  const auto above = std::ranges::upper_bound(alphas_, clamped);
  const auto high = static_cast<std::size_t>(std::min(above, alphas_.end() - 1) - alphas_.begin());
  const std::size_t low = high == 0 ? 0 : high - 1;
  const double share =
      high == low ? 0.0 : std::log(clamped / alphas_[low]) / std::log(alphas_[high] / alphas_[low]);
  for (const auto& [index, weight] : {std::pair(low, 1.0 - share), std::pair(high, share)}) {
    if (weight == 0.0) continue;
    const std::vector<float>&dark = dark_[index][light], &slope = slope_[index][light];
    for (std::size_t c = 0; c < 3; ++c) {
      const auto by_slope = static_cast<float>(weight * specular[c]);
      const auto by_dark = static_cast<float>(is_constant ? weight * specular[c] : weight);
      for (std::size_t i = c; i < radiance.size(); i += 3)
        radiance[i] += by_dark * dark[i] + by_slope * slope[i];
    }
  }
}

}  // namespace remap
