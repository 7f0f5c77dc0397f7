#include "renderer/steady_renderer.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/number_text.hpp"

namespace remap {
namespace {

constexpr int kResolution = 128;
// At this width the highlight covers about a hundred pixels.
constexpr double kNarrowWidth = 0.3;

// Returns the noise of one picture, computed from two pictures with different seeds. Their difference has
// sqrt(2) times the error of one.
Noise difference(const Image& a, const Image& b) {
  if (a.values.size() != b.values.size()) return {};  // PictureTaker reports pictures of the wrong size
  double apart = 0.0, power = 0.0, largest = 0.0, brightest = 0.0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const double x = a.values[i], y = b.values[i], mean = 0.5 * (x + y);
    apart += 0.5 * (x - y) * (x - y);
    power += mean * mean;
    largest = std::max(largest, std::fabs(x - y) / std::sqrt(2.0));
    brightest = std::max(brightest, mean);
  }
  if (!(power > 0.0)) return {};
  return {std::sqrt(apart / power), largest / brightest, 1};
}

std::string percent(double share) { return number_text(rounded(100.0 * share, 2)) + " %"; }

Noise measure(const Renderer& renderer, const ModelDescription& model, const Light& light) {
  Noise noise;
  const double full = model.parameter(ParameterRole::kSpecular).range.max;
  for (const double alpha : {std::clamp(kNarrowWidth, model.alpha.min, model.alpha.max), model.alpha.max}) {
    const Material material = grey_material(model, alpha, full, 0.0);
    const Noise found = difference(renderer.render(material, {kResolution, 1, light, 0}),
                                   renderer.render(material, {kResolution, 1, light, 1}));
    noise.level = std::max(noise.level, found.level);
    noise.largest = std::max(noise.largest, found.largest);
  }
  const double needed = std::ceil(noise.level * noise.level / (kSteadyNoise * kSteadyNoise));
  if (needed > kMostSeeds)
    throw input_error(model.name + ": pictures of two seeds differ by " + percent(noise.level) + " rms; " +
                      number_text(needed) +
                      " pictures would have to be averaged to reduce this difference to " +
                      percent(kSteadyNoise) + ", the limit is " + std::to_string(kMostSeeds) +
                      " (use a model without noise, or more samples per pixel in the worker)");
  noise.pictures = std::max(1, static_cast<int>(needed));
  return noise;
}

}  // namespace

SteadyRenderer::SteadyRenderer(const Renderer& inner, const std::vector<std::string>& models,
                               const Light& light)
    : inner_(inner) {
  for (const std::string& name : models) {
    const ModelDescription model = inner.model(name);
    if (model.is_external && !noise_.contains(name)) noise_[name] = measure(inner, model, light);
  }
}

ModelDescription SteadyRenderer::model(const std::string& name) const {
  ModelDescription model = inner_.model(name);
  if (const auto found = noise_.find(name); found != noise_.end()) {
    const Noise& noise = found->second;
    model.precision =
        std::max(model.precision, noise.largest / std::sqrt(static_cast<double>(noise.pictures)));
  }
  return model;
}

Image SteadyRenderer::render(const Material& material, const Scene& scene) const {
  const auto found = noise_.find(material.model);
  const int pictures = found == noise_.end() ? 1 : found->second.pictures;
  Image mean = inner_.render(material, scene);
  if (pictures == 1) return mean;
  std::vector<double> sums(mean.values.begin(), mean.values.end());
  for (int i = 1; i < pictures; ++i) {
    Scene again = scene;
    again.seed += i;
    const Image image = inner_.render(material, again);
    for (std::size_t p = 0; p < sums.size(); ++p) sums[p] += image.values[p];
  }
  std::transform(sums.begin(), sums.end(), mean.values.begin(),
                 [&](double sum) { return static_cast<float>(sum / pictures); });
  return mean;
}

}  // namespace remap
