// Pictures of all materials of one lobe at once: a picture is linear in diffuse reflectance and F0, so three
// for each light and width give all others.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "report/color.hpp"
#include "report/lit_sphere.hpp"

namespace remapc {

// Of a surface with a Lambertian lobe and a GGX lobe under Schlick's Fresnel, linear, a channel each.
struct Reflectances {
  Rgb diffuse{}, f0{};
};

// Linear RGB of a sphere, three values a pixel: diffuse reflectance times `diffuse`, plus `dark`, plus F0
// times `slope`.
struct BasisPictures {
  std::vector<float> diffuse, dark, slope;
};

// The sphere of the sweep scene at some widths, under environments and by a light at the camera.
class LitReflectances {
 public:
  // `alphas`: microfacet widths, above 0. Lights count through `environments` (of one grid, as
  // RadiancePyramid takes them); the last is the headlight, as bright as makes a white diffuse surface white
  // where it is nearest. Throws as render_spheres does; `sampling.progress` is called `sampling.resolution`
  // times an alpha.
  LitReflectances(std::span<const Environment> environments, std::span<const double> alphas,
                  const SphereSampling& sampling);

  std::size_t environment_count() const { return environment_count_; }
  std::size_t headlight() const { return environment_count_; }
  int resolution() const { return resolution_; }
  // Indices, row by row, of the pixels that show the sphere.
  const std::vector<std::uint32_t>& pixels() const { return pixels_; }

  const BasisPictures& basis(std::size_t alpha, std::size_t light) const {
    return bases_[alpha * (environment_count_ + 1) + light];
  }
  // Linear RGB, three values a pixel of pixels().
  std::vector<float> radiance(std::size_t alpha, std::size_t light, const Reflectances& surface) const;

 private:
  std::size_t environment_count_;
  int resolution_;
  std::vector<std::uint32_t> pixels_;
  std::vector<BasisPictures> bases_;  // light by light, for each alpha
};

}  // namespace remapc
