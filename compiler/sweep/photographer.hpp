// Takes the pictures that a match compares: every light of the objective, the pixels that show the sphere,
// one after the other as one row of floats.
#pragma once

#include <vector>

#include "sweep/objective.hpp"
#include "sweep/renderer.hpp"

namespace remapc {

// What to photograph: a grey material in canonical coordinates.
struct Sitting {
  double alpha = 0.0;
  double specular = 0.0;
  double diffuse = 0.0;
};

class Photographer {
 public:
  Photographer(const Renderer& renderer, const Objective& objective, int resolution, int samples_per_axis);

  // Pictures of `model` under each light in turn, pixel_count() floats each. Throws kInput for a picture of
  // another size, and for values that are not finite.
  std::vector<float> take(const ModelDescription& model, const Sitting& sitting) const;

  // Pixels of one picture that show the sphere, and their view cosines.
  std::size_t pixel_count() const { return cosines_.size(); }
  const std::vector<float>& view_cosines() const { return cosines_; }
  const Objective& objective() const { return objective_; }

 private:
  const Renderer& renderer_;
  Objective objective_;
  int resolution_;
  int samples_per_axis_;
  std::vector<std::size_t> pixels_;
  std::vector<float> cosines_;
};

// How a model's pictures depend on its specular parameter, found by rendering.
struct SpecularResponse {
  bool affine = false;        // picture = base + specular * slope
  bool proportional = false;  // affine, and base is black
  double residual = 0.0;      // largest deviation from affine, relative to the brightest pixel
};

// Renders `model` at three widths within `alphas` and three specular values within [0, max_specular] each.
SpecularResponse probe_specular(const Photographer& photographer, const ModelDescription& model,
                                const remap::Range& alphas, double max_specular);

// The factor between the diffuse parameters of two models that gives the same diffuse light, in least
// squares, and what is left then relative to the source (RMS). What the diffuse parameter adds to the picture
// is taken as the difference of two pictures, so a Fresnel rim does not count as diffuse. First stage of the
// two-stage match (section 3.1).
struct DiffuseMatch {
  double scale = 1.0;
  double error = 0.0;
};
DiffuseMatch match_diffuse(const Photographer& photographer, const ModelDescription& source,
                           const ModelDescription& target);

}  // namespace remapc
