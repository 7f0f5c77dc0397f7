// Renderers whose pictures are random: how random they are, and means over seeds in place of single pictures.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "renderer/renderer.hpp"

namespace remapc {

// What another seed does to the pictures of a model.
struct Noise {
  double level = 0.0;    // RMS difference from the mean over seeds, relative to the RMS of the picture
  double largest = 0.0;  // of one pixel, relative to the brightest pixel
  int pictures = 1;      // that are averaged, so that kSteadyNoise of the level is left
};

// A match averages over thousands of pixels, so this much moves it by some 1e-4.
inline constexpr double kSteadyNoise = 0.01;
// More pictures for one are more than a sweep can wait for.
inline constexpr int kMostSeeds = 64;

// `inner` with the pictures of some models averaged over as many seeds as their noise asks for. Other models
// pass through. The noise is measured, whatever the description of a model says.
class SteadyRenderer final : public Renderer {
 public:
  // Measures the noise of those of `models` that are external: two pictures each at two widths, 128^2, under
  // `light`. Throws kInput where more than kMostSeeds pictures would be needed, kUsage for unknown models.
  SteadyRenderer(const Renderer& inner, const std::vector<std::string>& models, const Light& light);

  // Of a model that was measured.
  const Noise& noise(const std::string& model) const { return noise_.at(model); }
  bool measured(const std::string& model) const { return noise_.contains(model); }

  std::string version() const override { return inner_.version(); }
  std::string version_of(const std::string& model) const override { return inner_.version_of(model); }
  std::vector<ModelDescription> models() const override { return inner_.models(); }
  // With the noise that is left as the precision of its pictures.
  ModelDescription model(const std::string& name) const override;
  Image render(const Material& material, const Scene& scene) const override;

 private:
  const Renderer& inner_;
  std::map<std::string, Noise> noise_;
};

}  // namespace remapc
