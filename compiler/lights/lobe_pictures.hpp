// This file renders the lobe of one model under many lights. A picture is linear in diffuse reflectance and
// specular, and smooth in alpha. So these pictures give the picture of every material with this lobe.
#pragma once

#include <string>
#include <vector>

#include "look/environment.hpp"
#include "look/image.hpp"
#include "look/lit_sphere.hpp"

namespace remap {

// A StudyLights holds environments, and after these point lights. Under a point light, a white diffuse sphere
// has radiance 1 at its closest point, if this faces the light. Angles are in degrees from the camera.
class StudyLights {
 public:
  StudyLights(std::vector<Environment> environments, const SphereSampling& sampling,
              std::vector<double> angles = {60.0});

  std::size_t environment_count() const { return environments_.size(); }
  std::size_t count() const { return environments_.size() + angles_.size(); }
  const std::vector<Environment>& environments() const { return environments_; }
  int resolution() const { return sampling_.resolution; }
  const SphereSampling& sampling() const { return sampling_; }
  // Returns row-major indices of the pixels that show the sphere.
  const std::vector<std::uint32_t>& pixels() const { return pixels_; }
  // Returns the picture of a white Lambertian sphere: linear RGB of pixels().
  const std::vector<float>& diffuse(std::size_t light) const { return diffuse_[light]; }
  // Returns the picture of a built-in model under point light `light`, with alpha and specular.
  std::vector<float> point_lit(std::size_t light, const std::string& model, double alpha, double specular,
                               double diffuse) const;

 private:
  std::vector<Environment> environments_;
  std::vector<double> angles_;
  SphereSampling sampling_;
  std::vector<std::uint32_t> pixels_;
  std::vector<std::vector<float>> diffuse_;
};

class LobePictures {
 public:
  // Renders the lobe at `alphas`, in ascending order. Throws the errors of render_spheres().
  LobePictures(const StudyLights& lights, const std::string& model, std::vector<double> alphas);

  const std::vector<double>& alphas() const { return alphas_; }
  // Adds the lobe to a picture, which is linear RGB of pixels(). Alpha is clamped to alphas(), and
  // interpolated between them by its logarithm. With `is_constant`, the reflectance of the lobe is specular
  // in every direction. Otherwise, it is the reflectance of the model.
  void add(std::size_t light, double alpha, const Rgb& specular, bool is_constant,
           std::vector<float>& radiance) const;

 private:
  std::vector<double> alphas_;
  // The indices are [alpha][light]. `dark_` is the picture at specular 0, and `slope_` what specular 1 adds.
  std::vector<std::vector<std::vector<float>>> dark_, slope_;
};

}  // namespace remap
