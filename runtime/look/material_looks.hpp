// This file shows a material before and after a conversion: in the source's model, in the target's model with
// the same numbers, and in the target's model with converted numbers.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "look/brdf_models.hpp"
#include "look/lit_sphere.hpp"
#include "look/scaled_maps.hpp"
#include "remap/path.hpp"
#include "remap/workflow.hpp"

namespace remap {

// Returns true if another renderer must show the ball.
inline bool is_external(const TexturedBall& ball) { return !ball.name.empty() && !is_linear_lobe(ball.name); }

// A MaterialLooks is one material on balls.
struct MaterialLooks {
  std::string name;
  TexturedBall source;
  std::optional<TexturedBall> copied;  // none if source and target have other parameters
  TexturedBall converted;
  Image normals;             // of all balls (render_textured); no values without a normal map
  ScaledMaps before, after;  // in the parameters of source and target
  double outside = 0.0;  // fraction of the texels outside of the range that the conversion was measured for
};

// A PictureError compares a picture with the source's, in display values (sRGB) over the pixels that show the
// shape.
struct PictureError {
  double ssim = 0.0;  // similarity of luma, 1 for equal pictures
  double rms = 0.0;   // error over red, green and blue
};

PictureError picture_error(const DisplayedSphere& source, const DisplayedSphere& other,
                           std::span<const std::uint32_t> pixels, int resolution);

// A LitLooks holds the pictures of a MaterialLooks: source, copied if there is one, and converted.
struct LitLooks {
  std::vector<DisplayedSphere> pictures;
  std::optional<PictureError> copied;
  PictureError converted;
};

// Environments of previews have this many rows. With fewer, the edges of lamps blur in the highlights of
// smooth materials.
inline constexpr int kPreviewLightRows = 256;

// Renders balls with normals: returns linear RGB for each ball, for the pixels of shape_pixels(kSphere).
using BallRenderer =
    std::function<std::vector<std::vector<float>>(std::span<const TexturedBall> balls, const Image& normals)>;

LitLooks light(const MaterialLooks& looks, const BallRenderer& render, int resolution);

// Decides whether a renderer has a model, by its name.
using ModelTest = std::function<bool(const std::string&)>;

// A ShownModel is a BRDF model as a renderer shows it. A model that the renderer lacks is shown by the model
// that a converter of the graph matches best to it.
class ShownModel {
 public:
  // `has` are the models of the renderer, by default of the built-in one. Throws kInput if no converter leads
  // from the model to one of them.
  ShownModel(const std::string& model, const ConverterGraph& graph, const ModelTest& has = is_linear_lobe);

  // Returns the name of the model that is shown.
  const std::string& name() const { return name_; }
  // Returns the ball of maps of a workflow over this model. Without one, they are roughness, specular,
  // diffuse.
  TexturedBall ball(const std::optional<WorkflowEnd>& workflow, ScaledMaps maps) const;

 private:
  std::string name_;
  std::unique_ptr<Converter> to_shown_;  // null if the model itself is shown
};

}  // namespace remap
