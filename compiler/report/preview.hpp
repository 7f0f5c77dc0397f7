// Previews a conversion: renders the source and the converted material side by side, on several shapes and at
// alphas that may differ from those of the sweep.
#pragma once

#include <string>
#include <vector>

#include "remap/fit.hpp"
#include "renderer/renderer.hpp"
#include "renderer/shape.hpp"

namespace remapc {

struct PreviewOptions {
  std::vector<double> alphas;    // of the source, canonical; empty: preview_alphas()
  std::vector<double> specular;  // of the source, in the fit's unit: one value, or red, green, blue; none:
                                 // half of what the domain covers
  std::vector<Shape> shapes = {Shape::kSphere, Shape::kTorus};
  Light light{45.0, 3.0};
  int resolution = 256;
  int samples_per_axis = 2;
};

// One pair of pictures. The figures are computed from display values (sRGB) over the pixels that show the
// shape. The exposure shows a white diffuse surface, facing the light where it is nearest, as white.
struct PreviewFigure {
  Shape shape = Shape::kSphere;
  double alpha = 0.0;                   // of the source
  double target_alpha = 0.0;            // canonical
  std::vector<double> target_specular;  // in the fit's unit
  bool in_domain = true;                // inside the domain of the fit
  double ssim = 0.0;                    // of luma
  double rms = 0.0;                     // over red, green and blue
};

struct Preview {
  std::vector<double> specular;        // of the source, as rendered
  std::vector<PreviewFigure> figures;  // by shape, then alpha
  // One column for each alpha; for each shape one row of the source, one of the conversion and one of four
  // times their difference.
  Image sheet;
};

// Four alphas in a geometric sequence over the part of 0.1 to 0.7 that the domain covers.
std::vector<double> preview_alphas(const remap::Domain& domain);

// Renders the preview. The source's pictures are multiplied by the factor between the light of the two
// renderers that the fit's table states. Throws kUsage for models that `renderer` does not have, invalid
// values, and without shapes.
Preview make_preview(const Renderer& renderer, const remap::Fit& fit, const PreviewOptions& options);

}  // namespace remapc
