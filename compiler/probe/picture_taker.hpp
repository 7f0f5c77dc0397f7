// Takes the pictures that a match compares: every light of the objective, the pixels that show the sphere,
// one after the other as one row of floats.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "probe/objective.hpp"
#include "probe/specular_family.hpp"
#include "probe/specular_response.hpp"
#include "renderer/renderer.hpp"

namespace remapc {

// What to photograph: a grey material.
struct RoleValues {
  double alpha = 0.0;
  double specular = 0.0;
  double diffuse = 0.0;
  std::map<std::string, double>
      others;  // of parameters of no role; missing ones are at their standard values

  RoleValues() = default;
  RoleValues(double alpha_value, double specular_value, double diffuse_value,
             std::map<std::string, double> other_values = {})
      : alpha(alpha_value),
        specular(specular_value),
        diffuse(diffuse_value),
        others(std::move(other_values)) {}
};

// A model as a sweep pictures it: with the law that its specular parameter was found to follow, and the
// factor that its pictures are multiplied by.
struct ProbedModel {
  ModelDescription model;
  SpecularResponse response;
  double exposure = 1.0;
  // Of a model without a law, where one was found (probe_family).
  std::optional<SpecularFamily> curve = std::nullopt;

  // How pictures depend on specular: by the law, else the curve. None where every picture must be rendered.
  std::optional<SpecularFamily> family() const;

  // Canonical speculars that the model takes, and those in which its picture is linear: they end at a knee.
  remap::Range specular_range() const;
  remap::Range linear_range() const;
  remap::Range diffuse_range() const;  // 0 to 0 where it has none
};

class PictureTaker {
 public:
  PictureTaker(const Renderer& renderer, const Objective& objective, int resolution, int samples_per_axis);

  // Pictures of `model` under each light in turn, pixel_count() floats each. Throws kInput for a picture of
  // another size, and for values that are not finite.
  // `specular` is the model's own parameter.
  std::vector<float> take(const ModelDescription& model, const RoleValues& role_values) const;

  // The same with canonical specular (clamped to what the model takes), times the exposure.
  std::vector<float> take(const ProbedModel& probed_model, const RoleValues& role_values) const;

  // The same for any grey material.
  std::vector<float> take(const Material& material) const;

  // The same for each channel of a material: one row where all its parameters are grey, else three.
  std::vector<std::vector<float>> take_channels(const Material& material) const;

  // squared_weights() of the objective for pictures that this took.
  std::vector<float> weights(const std::vector<float>& source) const;

  // The picture under the first light as a square, row 0 at the top, 0 beside the sphere.
  std::vector<float> square_picture(const std::vector<float>& row) const;

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

// Pictures of a probed_model that is affine in canonical specular, at one width: base + specular * slope, and
// the picture at the largest specular of the linear range. A probed_model in proportion is black at 0 and not
// rendered there: real renderers take their time.
struct AffinePictures {
  std::vector<float> base, slope, full;
};
AffinePictures take_affine(const PictureTaker& picture_taker, const ProbedModel& probed_model, double alpha);

// The pictures of the probed_model's family, which it must have, at one width: base and slope, or slope
// alone, of an affine one.
std::vector<std::vector<float>> take_family(const PictureTaker& picture_taker,
                                            const ProbedModel& probed_model, double alpha);

}  // namespace remapc
