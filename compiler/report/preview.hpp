// A conversion to look at: the source and what a fit makes of it, side by side, on shapes and for widths that
// were not those of the sweep.
#pragma once

#include <string>
#include <vector>

#include "model/fit.hpp"
#include "renderer/renderer.hpp"
#include "renderer/shape.hpp"

namespace remapc {

struct PreviewOptions {
  std::vector<double> alphas;    // of the source, canonical; none: preview_alphas()
  std::vector<double> specular;  // of the source, in the fit's unit: one value, or red, green, blue; none:
                                 // half of what the domain covers
  std::vector<Shape> shapes = {Shape::kSphere, Shape::kTorus};
  Light light{45.0, 3.0};
  int resolution = 256;
  int samples_per_axis = 2;
};

// One pair of pictures. Figures are those of display values (sRGB), exposed so that a white diffuse surface,
// hit at right angles where it is nearest to the light, is white; over the pixels that show the shape.
struct PreviewFigure {
  Shape shape = Shape::kSphere;
  double alpha = 0.0;                   // of the source
  double target_alpha = 0.0;            // canonical
  std::vector<double> target_specular;  // in the fit's unit
  bool in_domain = true;                // of the fit
  double ssim = 0.0;                    // of luma
  double rms = 0.0;                     // of red, green and blue
};

struct Preview {
  std::vector<double> specular;        // of the source, as rendered
  std::vector<PreviewFigure> figures;  // shape by shape, by alpha
  Image sheet;  // a column a width; for each shape a row of the source, the conversion, their difference four
                // times
};

// Four widths of the domain, each in the same ratio to the last: those of 0.1 to 0.7 that it covers.
std::vector<double> preview_alphas(const remap::Domain& domain);

// The source's pictures are multiplied by the factor between the light of the two renderers that the fit's
// table states. Throws kUsage for models that `renderer` has not, values that they do not take, no shapes.
Preview make_preview(const Renderer& renderer, const remap::Fit& fit, const PreviewOptions& options);

}  // namespace remapc
