// This file previews a conversion on several shapes. Under each light, it shows the source, the target with
// the numbers of the source, and the target with converted numbers. Without a conversion, people copy the
// numbers. Alphas need not occur in the sweep.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "look/environment.hpp"
#include "look/lit_sphere.hpp"
#include "look/material_looks.hpp"
#include "lower/fit.hpp"
#include "renderer/renderer.hpp"
#include "report/contact_sheet.hpp"

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

}  // namespace remap
