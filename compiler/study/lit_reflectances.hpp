// This file holds pictures from which the pictures of all materials with one lobe follow. A picture is linear
// in diffuse reflectance and F0, so three pictures for each light and alpha suffice. With these, a numerical
// search finds the base color and metallic whose pictures are the closest to those of a specular material.
// This is the smallest error of any conversion to the metallic workflow.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "look/image.hpp"
#include "look/lit_sphere.hpp"

namespace remap {

// A Reflectances is a surface with a Lambertian lobe and a GGX lobe with Schlick's Fresnel, in linear RGB.
struct Reflectances {
  Rgb diffuse{}, f0{};
};

// A BasisPictures gives a picture of the sphere as diffuse reflectance times `diffuse`, plus `dark`, plus F0
// times `slope`. It is linear RGB, three values per pixel.
struct BasisPictures {
  std::vector<float> diffuse, dark, slope;
};

// A LitReflectances holds pictures of the sphere of the sweep scene at several alphas, under environments and
// with a light at the camera (headlight).
class LitReflectances {
 public:
  // `alphas` are above 0. Light indices are as in `environments`, whose maps have one size, as
  // RadiancePyramid requires. The last index is the headlight, which gives the closest point of a white
  // diffuse sphere radiance 1. Throws the errors of render_spheres. Calls `sampling.progress`
  // `sampling.resolution` times for each alpha.
  LitReflectances(std::span<const Environment> environments, std::span<const double> alphas,
                  const SphereSampling& sampling);

  std::size_t environment_count() const { return environment_count_; }
  std::size_t headlight() const { return environment_count_; }
  int resolution() const { return resolution_; }
  // Returns row-major indices of the pixels that show the sphere.
  const std::vector<std::uint32_t>& pixels() const { return pixels_; }

  const BasisPictures& basis(std::size_t alpha, std::size_t light) const {
    return bases_[alpha * (environment_count_ + 1) + light];
  }
  // Returns linear RGB, three values for each of pixels().
  std::vector<float> radiance(std::size_t alpha, std::size_t light, const Reflectances& surface) const;

 private:
  std::size_t environment_count_;
  int resolution_;
  std::vector<std::uint32_t> pixels_;
  std::vector<BasisPictures> bases_;  // indexed by alpha, then light
};

// A MetallicReflection holds the reflectances of a metallic material (remap/workflow.hpp). With n = 1 -
// metallic, diffuse reflectance is diffuse_of_albedo * n * base color, and F0 is dielectric_f0 * n + metallic
// * base color.
struct MetallicReflection {
  double dielectric_f0 = 0.04;
  double diffuse_of_albedo = 1.0;
};

struct MetallicSurface {
  Rgb base_color{};
  double metallic = 0.0;
};

Reflectances reflectances_of(const MetallicSurface& surface, const MetallicReflection& reflection);

// Returns the surface with the smallest mean RMSE of display values over the environments of `lit`, at one of
// its alphas. Searches metallic on a grid of 33 values, and by golden sections around the best value.
// Searches base color by Newton's method. Compares a quarter of the pixels, so its RMSE may be a few
// thousandths above the smallest.
MetallicSurface best_metallic(const LitReflectances& lit, std::size_t alpha, const Reflectances& source,
                              const MetallicReflection& reflection);

}  // namespace remap
