// This file previews a conversion of a fit on several shapes. Under each light, it shows the source, the
// target with the numbers of the source, and the target with converted numbers. Without a conversion, people
// copy the numbers. Alphas need not occur in the sweep. It also previews the conversion of texture sets. It
// shows the maps on a ball in the source's shading. Then it shows the ball in the target's shading, with the
// same numbers and with converted numbers.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "look/environment.hpp"
#include "look/image.hpp"
#include "look/lit_sphere.hpp"
#include "look/material_looks.hpp"
#include "lower/fit.hpp"
#include "renderer/renderer.hpp"
#include "report/contact_sheet.hpp"
#include "texremap/plan/convert_plan.hpp"
#include "worker/renderer_set.hpp"

namespace remap {

// A PreviewLight is a point light, or an environment, which lights only spheres of the built-in renderer.
struct PreviewLight {
  std::string name;
  std::variant<Light, Environment> light;
};

// Reads `headlight` or degrees from the camera, -180 to 180, at `distance` in radii of the sphere. Also reads
// sky, overcast, studio or a file (EXR, HDR), whose mean luminance becomes `exposure` (> 0). Throws kUsage,
// and kInput like load_environment.
PreviewLight preview_light(const std::string& word, double distance, double exposure);

// Returns `studio` if the models are built-in and a sphere is shown, because `studio` lights only such
// spheres. Otherwise, returns `45`.
std::string default_light(const Fit& fit, const std::vector<Shape>& shapes);

struct PreviewOptions {
  std::vector<PreviewLight> lights;
  std::vector<Shape> shapes = {Shape::kSphere, Shape::kTorus};
  std::vector<double> alphas;    // alphas of the source; if empty, preview_alphas()
  std::vector<double> specular;  // of the source, in the fit's unit: one value, or red, green, blue; empty:
                                 // half of the domain
  double diffuse = 0.0;          // reflectance of a Lambertian lobe that all pictures have, 0 to 1
  int resolution = 160;          // width and height of each picture, pixels
  // N x N samples in each pixel; under an environment, they only find how much of a pixel the sphere covers
  int samples_per_axis = 2;
  int directions = 64;  // samples of an environment's light for each pixel
  std::function<void(double share)>
      progress;  // receives the finished fraction, 0 to 1; any thread; may throw
};

// A PreviewFigure is one source material, shown in three pictures.
struct PreviewFigure {
  std::string light;
  Shape shape = Shape::kSphere;
  double alpha = 0.0;                   // alpha of the source
  double target_alpha = 0.0;            // canonical
  std::vector<double> target_specular;  // in the fit's unit
  bool in_domain = true;                // whether the fit covers the source material
  PictureError copied, converted;
};

struct Preview {
  std::vector<double> specular;        // source specular that was rendered
  std::vector<PreviewFigure> figures;  // sorted by light, then shape, then alpha
  Image sheet;  // a row for each figure; columns: source, numbers copied, numbers converted; a margin of a
                // twentieth of the resolution around each picture
  SheetLabels labels;
};

// Returns four alphas in a geometric sequence over the part of 0.1 to 0.7 that the domain covers.
std::vector<double> preview_alphas(const Domain& domain);

// Makes a preview. The fit's table has the factor between the light of the two renderers, by which the
// source's pictures are multiplied. Throws kUsage for models that `renderer` lacks, for values out of range,
// for a diffuse reflectance that a model lacks, and without lights or shapes. Also throws kUsage for an
// environment without the sphere, or with models that are not built-in lobes with a scale or F0.
Preview make_preview(const Renderer& renderer, const Fit& fit, const PreviewOptions& options);

struct SetPreviewOptions {
  Environment light;
  std::string source, target;  // names above the pictures
  // Names of the workers that show the source and the target; if empty, the built-in renderer shows it.
  std::string renderer_before, renderer_after;
  const RendererSet* renderers = nullptr;  // has these workers
  int resolution = 440;                    // width and height of each ball, pixels
  int directions = 160;                    // samples of the light for each pixel, in the built-in renderer
  int external_directions = 128;           // in workers
  std::function<void(double share)> progress;  // called from any thread with the finished fraction, 0 to 1
};

// A SetFigure compares the pictures of one material with the source's picture.
struct SetFigure {
  std::string name;
  std::optional<PictureError> copied;  // none if source and target have other parameters
  PictureError converted;
  double outside = 0.0;  // MaterialLooks::outside
};

struct SetPreview {
  std::vector<SetFigure> figures;
  std::vector<std::string> notes;  // which models are shown by other models, and what is not shown
  std::string copied_title;        // what the middle column shows
  Image sheet;  // a row for each material; columns: source, numbers copied, numbers converted
  SheetLabels labels;
};

// Previews the first sets of a plan. Their maps are scaled down to the size of the picture. If a renderer
// lacks a model, it shows the model that a shipped converter matches best to it. Opacity is not
// shown. Throws kInput if a map cannot be read or a worker fails. Throws kUsage if the plan has no
// texture set, and for a worker that is unknown or has no model with textures.
SetPreview preview_sets(const ConvertPlan& plan, const SetPreviewOptions& options);

}  // namespace remap
