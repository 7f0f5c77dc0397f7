// This file renders the pictures that a match compares, under every light of the objective. It keeps only the
// pixels that show the sphere. All pictures are in one row of floats. If the objective compares means, each
// picture is followed by its mean over the square.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "measure/objective.hpp"
#include "measure/specular_response.hpp"
#include "renderer/renderer.hpp"

namespace remap {

// A RoleValues is a grey material. It has a value for each role of a model's parameters.
struct RoleValues {
  double alpha = 0.0;
  double specular = 0.0;
  double diffuse = 0.0;
  // Values of kOther parameters by name. A parameter that is missing here has its standard value.
  std::map<std::string, double> others;

  RoleValues() = default;
  RoleValues(double alpha_value, double specular_value, double diffuse_value,
             std::map<std::string, double> other_values = {})
      : alpha(alpha_value),
        specular(specular_value),
        diffuse(diffuse_value),
        others(std::move(other_values)) {}
};

// A ProbedModel is a model and what its pictures showed: the law of its specular parameter, and the factor
// for its pictures.
struct ProbedModel {
  ModelDescription model;
  SpecularResponse response;
  double exposure = 1.0;
  // This is set for a model without a law, if probe_family found a family.
  std::optional<SpecularFamily> curve = std::nullopt;

  // Returns how pictures depend on specular, from the law or from probe_family(). Returns nothing if every
  // picture must be rendered.
  std::optional<SpecularFamily> family() const;

  // Return the range of canonical specular that the model accepts, and the part up to the knee, in which
  // pictures are linear.
  Range specular_range() const;
  Range linear_range() const;
  Range diffuse_range() const;  // 0 to 0 for a model without diffuse
};

class PictureTaker {
 public:
  PictureTaker(const Renderer& renderer, const Objective& objective, int resolution, int samples_per_axis);

  // Renders `model` under one light after another. Each picture has pixel_count() floats, and the mean if the
  // objective compares means. `specular` is the model's own parameter. Throws kInput for a picture of another
  // size and for values that are not finite.
  std::vector<float> take(const ModelDescription& model, const RoleValues& role_values) const;

  // Renders with a canonical specular, clamped to the model's range, and applies the exposure.
  std::vector<float> take(const ProbedModel& probed_model, const RoleValues& role_values) const;

  std::vector<float> take(const Material& material) const;

  // Renders each channel of a material: one row if all its parameters are grey, otherwise three.
  std::vector<std::vector<float>> take_channels(const Material& material) const;

  // Returns squared_weights() of the objective for pictures that this object took.
  PictureWeights weights(const std::vector<float>& source) const;

  // Returns the picture under the first light as a square, row 0 at the top, 0 outside the sphere.
  std::vector<float> square_picture(const std::vector<float>& row) const;

  // Return the number of pixels that show the sphere, and the view cosine of each of them.
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

// An AffinePictures holds pictures, at one width, of a model that is affine in canonical specular: base +
// specular * slope. `full` is the picture at the largest specular of the linear range. The base of a
// proportional model is black and not rendered, because real renderers are slow.
struct AffinePictures {
  std::vector<float> base, slope, full;
};
AffinePictures take_affine(const PictureTaker& picture_taker, const ProbedModel& probed_model, double alpha);

// Returns the pictures of the model's family at one width. The model must have a family. For an affine
// family, these are base and slope, or only slope.
std::vector<std::vector<float>> take_family(const PictureTaker& picture_taker,
                                            const ProbedModel& probed_model, double alpha);

}  // namespace remap
