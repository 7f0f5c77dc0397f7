// This file renders the sphere of the sweep scene under environments instead of a point light, and compares
// such pictures in display values.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "look/brdf.hpp"
#include "look/environment.hpp"

namespace remap {

// A SphereMaterial is a model of the built-in renderer with its parameters. Specular is linear: a scale or
// F0. Diffuse is the reflectance of an additional Lambertian lobe.
struct SphereMaterial {
  BrdfModel model;
  double alpha = 0.0;
  double specular = 0.0;
  double diffuse = 0.0;
  bool operator==(const SphereMaterial&) const = default;
};

struct SphereSampling {
  int resolution = 128;            // width and height of the pictures in pixels
  int samples = 1024;              // light directions per pixel
  unsigned jobs = 0;               // threads; 0: one per core. Results do not depend on it
  std::function<void()> progress;  // called for each of `resolution` pixel rows, from any thread
  const std::atomic<bool>* cancelled = nullptr;  // set to true to stop; throws kInterrupted
  // If this is set, all pixels use the same directions. A few directions then give a smooth picture with a
  // smooth error. Otherwise, the error differs from pixel to pixel.
  bool shares_directions = false;
};

// A SpherePictures holds linear RGB pictures of materials under each environment, for the pixels that show
// the sphere. The directions of light form two halves, each with its own pictures. Their difference shows the
// sampling error.
class SpherePictures {
 public:
  SpherePictures(std::size_t material_count, std::size_t channel_count, int resolution);

  int resolution() const { return resolution_; }
  // Returns row-major indices of the pixels whose centers show the sphere.
  const std::vector<std::uint32_t>& pixels() const { return pixels_; }

  // Returns three values for each of pixels(): the mean of both halves, or one half (0 or 1).
  std::vector<float> radiance(std::size_t material, std::size_t environment) const;
  std::vector<float> half_radiance(std::size_t material, std::size_t environment, std::size_t half) const;

  // Returns all channels of a pixel. `pixel` is an index into pixels(). `half` is 0 or 1.
  float* values(std::size_t material, std::size_t half, std::size_t pixel);

 private:
  std::size_t offset(std::size_t material, std::size_t half, std::size_t pixel) const;

  std::size_t material_count_, channel_count_;
  int resolution_;
  std::vector<std::uint32_t> pixels_;
  std::vector<float> values_;
};

// Renders `materials` under all environments. All materials share the same directions, so that the noise of
// two materials mostly cancels in their difference. The directions are a mixture of GGX half vectors of the
// least and the largest alpha and of a cosine lobe, weighted by the balance heuristic (Veach and Guibas
// 1995). Radiance is averaged over the solid angle of each sample. Throws kUsage for a resolution or sample
// count out of range, and kInterrupted.
SpherePictures render_spheres(const RadiancePyramid& environments, std::span<const SphereMaterial> materials,
                              const SphereSampling& sampling);

// A BallTexel is a texel of a material on a ball: the width, F0 or scale of the lobe, and the Lambertian
// lobe.
struct BallTexel {
  double alpha = 0.0;
  Rgb specular{}, diffuse{};
};

// A TexturedBall is a material of a built-in model whose parameters are maps, row by row from the top. The
// maps cover the half of the ball that the camera sees: the point (x, y, z) has the texel at 1/2 + atan2(x,
// z) / pi of the width and acos(y) / pi of the height, interpolated between the closest four.
struct TexturedBall {
  BrdfModel model;
  int width = 0, height = 0;
  std::vector<BallTexel> texels;
  std::string name = {};  // of the model; of a model of another renderer, `model` has no meaning
};

// Renders `balls` under one environment. Returns linear RGB for each ball, for the pixels of
// shape_pixels(kSphere). All balls have the same directions, as in render_spheres(). `normals` bend the
// normals of all balls: for each texel x to the right, y up and z out of the surface, placed like the texels
// of the balls. An image without values bends nothing. Throws the errors of render_spheres().
std::vector<std::vector<float>> render_textured(const RadiancePyramid& environment,
                                                std::span<const TexturedBall> balls, const Image& normals,
                                                const SphereSampling& sampling);

// Converts linear values to display values (look/image.hpp).
std::vector<float> display_values(std::span<const float> radiance);

// A DisplayedSphere is a picture in display values. It may show another shape.
struct DisplayedSphere {
  std::vector<float> colors;  // RGB of the pixels that show the sphere
  std::vector<float> luma;    // luma of the whole picture, row-major; 0 outside the sphere
};

// Converts `radiance`, linear RGB of `pixels`. These are row-major indices into a square of `resolution`.
DisplayedSphere displayed_sphere(std::span<const float> radiance, std::span<const std::uint32_t> pixels,
                                 int resolution);

// Does the same as displayed_sphere() for `colors` that are display values already.
DisplayedSphere displayed_colors(std::vector<float> colors, std::span<const std::uint32_t> pixels,
                                 int resolution);

// Returns the mean structural similarity of luma over the pixels of the sphere; 1 means equal pictures.
double sphere_similarity(const DisplayedSphere& a, const DisplayedSphere& b,
                         std::span<const std::uint32_t> pixels, int resolution);

}  // namespace remap
