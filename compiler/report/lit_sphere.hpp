// The sphere of the sweep scene, seen by its camera and lit by environments instead of a point light.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "renderer/brdf.hpp"
#include "report/radiance_pyramid.hpp"

namespace remapc {

// A model of the built-in renderer with its parameters. Specular is linear: a scale, or F0. Diffuse is the
// reflectance of a Lambertian lobe beside it.
struct SphereMaterial {
  BrdfModel model;
  double alpha = 0.0;
  double specular = 0.0;
  double diffuse = 0.0;
  bool operator==(const SphereMaterial&) const = default;
};

struct SphereSampling {
  int resolution = 128;                          // width and height of the pictures, pixels
  int samples = 1024;                            // directions a pixel
  unsigned jobs = 0;                             // threads; 0: one a core. The pictures do not depend on it
  std::function<void()> progress;                // one of `resolution` pixel rows is done; from any thread
  const std::atomic<bool>* cancelled = nullptr;  // stops soon; throws kInterrupted
};

// Linear RGB pictures of `materials` under each environment, at the pixels that show the sphere. Two sets of
// directions are kept apart, so that their difference tells the sampling error.
class SpherePictures {
 public:
  SpherePictures(std::size_t material_count, std::size_t channel_count, int resolution);

  int resolution() const { return resolution_; }
  // Indices, row by row, of the pixels that show the sphere at their centre.
  const std::vector<std::uint32_t>& pixels() const { return pixels_; }

  // Three values a pixel of pixels(): the mean of both halves, or one of them (0, 1).
  std::vector<float> radiance(std::size_t material, std::size_t environment) const;
  std::vector<float> half_radiance(std::size_t material, std::size_t environment, std::size_t half) const;

  // All channels of a pixel, given as its place in pixels().
  float* values(std::size_t material, std::size_t half, std::size_t pixel);

 private:
  std::size_t offset(std::size_t material, std::size_t half, std::size_t pixel) const;

  std::size_t channel_count_;
  int resolution_;
  std::vector<std::uint32_t> pixels_;
  std::vector<float> values_;
};

// Directions are drawn for all materials together, by a mixture of GGX half vectors of their least and
// largest alpha and of a cosine lobe, weighted by the balance heuristic (Veach and Guibas 1995) and read from
// the pyramid over the solid angle that each stands for. So the noise of two materials is alike and mostly
// cancels in their difference. Throws kUsage for a resolution or sample count out of range, kInterrupted.
SpherePictures render_spheres(const RadiancePyramid& environments, std::span<const SphereMaterial> materials,
                              const SphereSampling& sampling);

}  // namespace remapc
