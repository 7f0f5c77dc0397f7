#include "study/lit_reflectances.hpp"

#include <array>
#include <numbers>

#include "renderer/renderer.hpp"

namespace remapc {
namespace {

constexpr BrdfModel kLobe{Brdf::kGgx, Fresnel::kSchlick};
constexpr BrdfModel kNoLobe{Brdf::kGgx, Fresnel::kNone};  // black at specular 0

std::vector<float> difference(const std::vector<float>& a, const std::vector<float>& b) {
  std::vector<float> values(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) values[i] = a[i] - b[i];
  return values;
}

// RGB values of `pixels` in grey pictures of the built-in renderer with the light at the camera.
BasisPictures headlight_basis(double alpha, int resolution, const std::vector<std::uint32_t>& pixels) {
  // A light at distance d gives the nearest point of a white diffuse sphere the radiance 1 / (pi (d - 1)^2).
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

}  // namespace remapc
