// This file averages the pictures of noisy renderers over several seeds. It first measures how noisy they
// are.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "renderer/renderer.hpp"

namespace remap {

// A Noise states how much the pictures of a model depend on the seed.
struct Noise {
  double level = 0.0;    // RMS difference from the mean over seeds, relative to the RMS of the picture
  double largest = 0.0;  // largest difference of one pixel, relative to the brightest pixel
  int pictures = 1;      // number of pictures that reduces the level to kSteadyNoise
};

// A match sums over thousands of pixels, so this level changes it by about 1e-4.
inline constexpr double kSteadyNoise = 0.01;
// Averaging more pictures than this makes a sweep too slow.
inline constexpr int kMostSeeds = 64;

// A SteadyRenderer renders like `inner`. It measures the noise of external models, because descriptions may
// be wrong, and averages the pictures of noisy models over as many seeds as needed. Pictures of other models
// are returned unchanged.
class SteadyRenderer final : public Renderer {
 public:
  // Measures the noise of the external models among `models` under `light`. For each model, compares two
  // pictures of 128 x 128 pixels at each of two widths. Throws kInput if more than kMostSeeds pictures would
  // be needed, and kUsage for unknown models.
  SteadyRenderer(const Renderer& inner, const std::vector<std::string>& models, const Light& light);

  // Returns the noise of a model that was measured.
  const Noise& noise(const std::string& model) const { return noise_.at(model); }
  bool measured(const std::string& model) const { return noise_.contains(model); }

  std::string version() const override { return inner_.version(); }
  std::string version_of(const std::string& model) const override { return inner_.version_of(model); }
  std::vector<ModelDescription> models() const override { return inner_.models(); }
  // Returns the description. Its precision includes the noise that remains after averaging.
  ModelDescription model(const std::string& name) const override;
  Image render(const Material& material, const Scene& scene) const override;

 private:
  const Renderer& inner_;
  std::map<std::string, Noise> noise_;
};

}  // namespace remap
