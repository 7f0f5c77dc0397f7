// Previews a conversion. Under a light: the source and the converted material side by side, on several shapes
// and at alphas that may differ from those of the sweep. Under an environment: the source, the target with
// the numbers of the source, and the target with converted numbers. Copying the numbers is what a conversion
// competes with.
#pragma once

#include <string>
#include <vector>

#include "lower/fit.hpp"
#include "renderer/renderer.hpp"
#include "report/environment.hpp"
#include "report/sheet_labels.hpp"

namespace remap {

// The materials and pictures of a preview.
struct PreviewMaterials {
  std::vector<double> alphas;    // of the source, canonical; empty: preview_alphas()
  std::vector<double> specular;  // of the source, in the fit's unit: one value, or red, green, blue; empty:
                                 // half of the domain
  int resolution = 256;          // width and height of each picture, pixels
  int samples_per_axis = 2;      // N x N samples in each pixel
};

struct PreviewOptions : PreviewMaterials {
  std::vector<Shape> shapes = {Shape::kSphere, Shape::kTorus};
  Light light{45.0, 3.0};
};

struct LitPreviewOptions : PreviewMaterials {
  double diffuse = 0.0;  // reflectance of a Lambertian lobe that all spheres have, 0 to 1
  int directions = 512;  // light directions for each sample
};

// One source material and its conversion.
struct PreviewedMaterial {
  double alpha = 0.0;                   // of the source
  double target_alpha = 0.0;            // canonical
  std::vector<double> target_specular;  // in the fit's unit
  bool in_domain = true;                // of the fit
};

// One pair of pictures. The figures are computed from display values (sRGB) over the pixels that show the
// shape. The exposure shows a white diffuse surface, facing the light where it is nearest, as white.
struct PreviewFigure : PreviewedMaterial {
  Shape shape = Shape::kSphere;
  double ssim = 0.0;  // of luma
  double rms = 0.0;   // over red, green and blue
};

// How far one picture is from the source's, in display values (sRGB) over the pixels that show the sphere.
struct LitSimilarity {
  double ssim = 0.0;  // of luma, 1 for equal pictures
  double rms = 0.0;   // of red, green and blue
};

struct LitFigure : PreviewedMaterial {
  LitSimilarity copied, converted;
};

struct Preview {
  std::vector<double> specular;        // of the source, as rendered
  std::vector<PreviewFigure> figures;  // by shape, then alpha
  // One column for each alpha; for each shape one row of the source, one of the conversion and one of four
  // times their difference.
  Image sheet;
  SheetLabels labels;  // models, and the numbers of source and conversion
};

// Four alphas in a geometric sequence over the part of 0.1 to 0.7 that the domain covers.
std::vector<double> preview_alphas(const Domain& domain);

// Renders the preview. The source's pictures are multiplied by the factor between the light of the two
// renderers that the fit's table states. Throws kUsage for models that `renderer` does not have, invalid
// values, and without shapes.
Preview make_preview(const Renderer& renderer, const Fit& fit, const PreviewOptions& options);

struct LitPreview {
  std::vector<double> specular;    // of the source, as rendered
  std::vector<LitFigure> figures;  // by alpha
  Image sheet;  // a row for each alpha; columns: source, numbers copied, numbers converted; a margin of a
                // twentieth of the resolution around each picture
  SheetLabels labels;
};

// The built-in environment of this name (sky, overcast, studio), or the one of this file; its mean luminance
// becomes `exposure` (> 0). Throws kUsage, and kInput as load_environment does.
Environment environment_for_preview(const std::string& name_or_file, double exposure);

// Both models of `fit` must be lobes of the built-in renderer with a scale or F0: throws kUsage otherwise,
// and for values out of range.
LitPreview make_lit_preview(const Fit& fit, const Environment& environment, const LitPreviewOptions& options);

}  // namespace remap
