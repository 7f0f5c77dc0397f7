// Judges rules that convert materials by the pictures of what they give.
#pragma once

#include <functional>
#include <vector>

#include "lights/lobe_pictures.hpp"
#include "lower/short_form.hpp"

namespace remap {

// A material of the source: a lobe and a Lambertian; linear.
struct LobeMaterial {
  double alpha = 0.0;
  Rgb specular{}, diffuse{};
};

// What a rule makes of it. With `is_constant` the lobe reflects specular in every direction, else by the
// Fresnel term of the target.
struct LobeSurface {
  double alpha = 0.0;
  Rgb specular{}, diffuse{};
  bool is_constant = false;
};
using LobeRule = std::function<LobeSurface(const LobeMaterial&)>;

// Of one material: the mean RMSE of display values over the environments, in percent, and the error relative
// to the source under the point light, with the weights of the objective natural-1.
struct RuleError {
  double rmse = 0.0, relative = 0.0;
};

// The least that any parameters reach, each error by its own.
struct LeastError {
  RuleError error;
  LobeSurface by_rmse, by_relative;
};

// The error of each material; of all, mean RMSE and SSIM and the median relative error.
struct Judged {
  std::vector<RuleError> errors;
  ShortFigures figures;
};

// The upper one of two in the middle; 0 of none.
double median(std::vector<double> values);

class RuleJudge {
 public:
  // The alphas of `materials` are among those of `source`. All must outlive it.
  RuleJudge(const StudyLights& lights, const LobePictures& source, const LobePictures& target,
            std::vector<LobeMaterial> materials);

  const std::vector<LobeMaterial>& materials() const { return materials_; }
  std::vector<RuleError> errors(const LobeRule& rule) const;
  // The least errors of surfaces whose specular is that of the material times a number, whose diffuse is the
  // rule's, and whose alpha is within a factor of 2.5 of that of the rule. Alpha and the number are searched.
  std::vector<LeastError> least(const LobeRule& rule) const;
  Judged by_rule(const LobeRule& rule) const;
  // By the least errors that start from the rule.
  Judged by_least(const LobeRule& rule) const;

 private:
  Judged judged(std::vector<RuleError> errors, const std::vector<LobeSurface>& surfaces) const;
  RuleError error_of(std::size_t material, const LobeSurface& surface) const;
  double rmse_of(std::size_t material, const LobeSurface& surface) const;
  double relative_of(std::size_t material, const LobeSurface& surface) const;
  double similarity_of(std::size_t material, const LobeSurface& surface) const;
  std::vector<float> radiance(std::size_t light, const LobeSurface& surface) const;

  // A material under the lights.
  struct Shown {
    std::vector<std::vector<float>> display;  // for each environment
    std::vector<float> point, weights;        // under the point light: linear, and w^2
    double power = 0.0;                       // sum of w^2 point^2
  };

  const StudyLights& lights_;
  const LobePictures &source_, &target_;
  std::vector<LobeMaterial> materials_;
  std::vector<Shown> shown_;
};

}  // namespace remap
