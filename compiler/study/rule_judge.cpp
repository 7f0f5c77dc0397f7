#include "study/rule_judge.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.hpp"
#include "lights/display_curve.hpp"
#include "measure/objective.hpp"
#include "renderer/image_similarity.hpp"
#include "renderer/scene.hpp"
#include "study/golden_section.hpp"

namespace remap {
namespace {

constexpr double kWidestFactor = 2.5;
constexpr int kStrengthSteps = 12;

void add_diffuse(const std::vector<float>& white, const Rgb& diffuse, std::vector<float>& radiance) {
  for (std::size_t c = 0; c < 3; ++c) {
    const auto by = static_cast<float>(diffuse[c]);
    for (std::size_t i = c; i < radiance.size(); i += 3) radiance[i] += by * white[i];
  }
}

Rgb scaled(const Rgb& color, double factor) {
  return {color[0] * factor, color[1] * factor, color[2] * factor};
}

}  // namespace

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values.empty() ? 0.0 : values[values.size() / 2];
}

RuleJudge::RuleJudge(const StudyLights& lights, const LobePictures& source, const LobePictures& target,
                     std::vector<LobeMaterial> materials)
    : lights_(lights), source_(source), target_(target), materials_(std::move(materials)) {
  const Objective objective = objective_preset("natural-1");
  const std::vector<float> all_cosines = view_cosines(lights.resolution(), 1);
  std::vector<float> cosines;
  for (const std::uint32_t pixel : lights.pixels()) cosines.push_back(all_cosines[pixel]);
  shown_.resize(materials_.size());
  run_parallel(materials_.size(), lights.sampling().jobs, [&](std::size_t m) {
    const LobeMaterial& material = materials_[m];
    Shown& shown = shown_[m];
    for (std::size_t light = 0; light < lights_.count(); ++light) {
      std::vector<float> picture(3 * lights_.pixels().size(), 0.0f);
      add_diffuse(lights_.diffuse(light), material.diffuse, picture);
      source_.add(light, material.alpha, material.specular, false, picture);
      if (light == lights_.point_light())
        shown.point = std::move(picture);
      else
        shown.display.push_back(display_values(picture));
    }
    shown.weights.resize(shown.point.size());
    for (std::size_t c = 0; c < 3; ++c) {
      std::vector<float> channel;
      for (std::size_t i = c; i < shown.point.size(); i += 3) channel.push_back(shown.point[i]);
      const PictureWeights weights = squared_weights(objective, channel, cosines);
      for (std::size_t i = 0; i < channel.size(); ++i) shown.weights[3 * i + c] = weights.squared[i];
    }
    for (std::size_t i = 0; i < shown.point.size(); ++i)
      shown.power += static_cast<double>(shown.weights[i]) * static_cast<double>(shown.point[i]) *
                     static_cast<double>(shown.point[i]);
  });
}

std::vector<float> RuleJudge::radiance(std::size_t light, const LobeSurface& surface) const {
  std::vector<float> picture(3 * lights_.pixels().size(), 0.0f);
  add_diffuse(lights_.diffuse(light), surface.diffuse, picture);
  target_.add(light, surface.alpha, surface.specular, surface.is_constant, picture);
  return picture;
}

double RuleJudge::rmse_of(std::size_t material, const LobeSurface& surface) const {
  const DisplayCurve& curve = display_curve();
  double sum = 0.0;
  for (std::size_t light = 0; light < lights_.environment_count(); ++light) {
    const std::vector<float> picture = radiance(light, surface), &shown = shown_[material].display[light];
    double square = 0.0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
      const auto error = static_cast<double>(curve(picture[i]).first - shown[i]);
      square += error * error;
    }
    sum += std::sqrt(square / static_cast<double>(picture.size()));
  }
  return 100.0 * sum / static_cast<double>(lights_.environment_count());
}

double RuleJudge::relative_of(std::size_t material, const LobeSurface& surface) const {
  const Shown& shown = shown_[material];
  const std::vector<float> picture = radiance(lights_.point_light(), surface);
  double sum = 0.0;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const auto error = static_cast<double>(picture[i] - shown.point[i]);
    sum += static_cast<double>(shown.weights[i]) * error * error;
  }
  return shown.power > 0.0 ? std::sqrt(sum / shown.power) : 0.0;
}

double RuleJudge::similarity_of(std::size_t material, const LobeSurface& surface) const {
  double sum = 0.0;
  for (std::size_t light = 0; light < lights_.environment_count(); ++light)
    sum += sphere_similarity(
        displayed_colors(shown_[material].display[light], lights_.pixels(), lights_.resolution()),
        displayed_sphere(radiance(light, surface), lights_.pixels(), lights_.resolution()), lights_.pixels(),
        lights_.resolution());
  return sum / static_cast<double>(lights_.environment_count());
}

RuleError RuleJudge::error_of(std::size_t material, const LobeSurface& surface) const {
  return {rmse_of(material, surface), relative_of(material, surface)};
}

std::vector<RuleError> RuleJudge::errors(const LobeRule& rule) const {
  std::vector<RuleError> errors(materials_.size());
  run_parallel(materials_.size(), lights_.sampling().jobs,
               [&](std::size_t m) { errors[m] = error_of(m, rule(materials_[m])); });
  return errors;
}

std::vector<LeastError> RuleJudge::least(const LobeRule& rule) const {
  std::vector<LeastError> all(materials_.size());
  run_parallel(materials_.size(), lights_.sampling().jobs, [&](std::size_t m) {
    const LobeSurface start = rule(materials_[m]);
    const double largest = *std::ranges::max_element(materials_[m].specular);
    LeastError& least = all[m];
    least.error = error_of(m, start);
    least.by_rmse = least.by_relative = start;
    if (largest <= 0.0) return;
    const auto search = [&](double alpha, const auto& error, double& best, LobeSurface& at) {
      const auto surface = [&](double strength) {
        LobeSurface tried = start;
        tried.alpha = alpha;
        tried.specular = scaled(materials_[m].specular, strength / largest);
        return tried;
      };
      const auto [root, value] =
          golden_section(0.0, 1.0, kStrengthSteps, [&](double s) { return error(m, surface(s * s)); });
      if (value >= best) return;
      best = value;
      at = surface(root * root);
    };
    for (const double alpha : target_.alphas()) {
      if (alpha < start.alpha / kWidestFactor || alpha > start.alpha * kWidestFactor) continue;
      search(
          alpha, [this](std::size_t i, const LobeSurface& s) { return rmse_of(i, s); }, least.error.rmse,
          least.by_rmse);
      search(
          alpha, [this](std::size_t i, const LobeSurface& s) { return relative_of(i, s); },
          least.error.relative, least.by_relative);
    }
  });
  return all;
}

Judged RuleJudge::judged(std::vector<RuleError> errors, const std::vector<LobeSurface>& surfaces) const {
  std::vector<double> similarities(surfaces.size()), relative;
  run_parallel(surfaces.size(), lights_.sampling().jobs,
               [&](std::size_t m) { similarities[m] = similarity_of(m, surfaces[m]); });
  ShortFigures figures;
  for (std::size_t m = 0; m < errors.size(); ++m) {
    figures.rmse += errors[m].rmse / static_cast<double>(errors.size());
    figures.ssim += similarities[m] / static_cast<double>(errors.size());
    relative.push_back(errors[m].relative);
  }
  figures.relative = median(std::move(relative));
  return {std::move(errors), figures};
}

Judged RuleJudge::by_rule(const LobeRule& rule) const {
  std::vector<LobeSurface> surfaces;
  for (const LobeMaterial& material : materials_) surfaces.push_back(rule(material));
  return judged(errors(rule), surfaces);
}

Judged RuleJudge::by_least(const LobeRule& rule) const {
  std::vector<LobeSurface> surfaces;
  std::vector<RuleError> errors;
  for (const LeastError& least : this->least(rule)) {
    surfaces.push_back(least.by_rmse);
    errors.push_back(least.error);
  }
  return judged(std::move(errors), surfaces);
}

}  // namespace remap
