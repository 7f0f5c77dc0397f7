// This file renders the lobe of one model under many lights. Pictures of every material with that lobe follow
// from these, because a picture is linear in diffuse reflectance and specular, and smooth in alpha.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "look/environment.hpp"
#include "look/image.hpp"
#include "look/lit_sphere.hpp"

namespace remap {

// A StudyLights holds environments, and after them point lights. Under a point light, the closest point of a
// white diffuse sphere that faces the light has radiance 1. The angles to the camera are in degrees.
class StudyLights {
 public:
  StudyLights(std::vector<Environment> environments, const SphereSampling& sampling,
              std::vector<double> angles = {60.0});

  std::size_t environment_count() const { return environments_.size(); }
  std::size_t count() const { return environments_.size() + angles_.size(); }
  std::size_t point_light() const { return environments_.size(); }  // index of the first point light
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
  // Adds the lobe to a picture, linear RGB of pixels(). Alpha is clamped to alphas(), and interpolated
  // between them in its logarithm. With `is_constant` the reflectance of the lobe is specular in every
  // direction, otherwise it is the model's own.
  void add(std::size_t light, double alpha, const Rgb& specular, bool is_constant,
           std::vector<float>& radiance) const;

 private:
  std::vector<double> alphas_;
  // The order is [alpha][light]. They hold the picture at specular 0, and what specular 1 adds.
  std::vector<std::vector<std::vector<float>>> dark_, slope_;
};

}  // namespace remap
