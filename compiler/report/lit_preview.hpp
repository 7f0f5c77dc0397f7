// A conversion under an environment: the source, the target with the numbers of the source, and the target
// with converted numbers, side by side. Copying the numbers is what a conversion competes with.
#pragma once

#include <string>
#include <vector>

#include "remap/fit.hpp"
#include "report/environment.hpp"

namespace remapc {

struct LitPreviewOptions {
  std::vector<double> alphas;    // of the source, canonical; empty: preview_alphas() of the domain
  std::vector<double> specular;  // of the source: one value, or red, green, blue; empty: half of the domain
  double diffuse = 0.0;          // reflectance of a Lambertian lobe that all spheres have, 0 to 1
  int resolution = 256;          // width and height of each picture, pixels
  int samples_per_axis = 2;      // N x N samples in each pixel
  int directions = 512;          // light directions for each sample
};

// How far one picture is from the source's, in display values (sRGB) over the pixels that show the sphere.
struct LitSimilarity {
  double ssim = 0.0;  // of luma, 1 for equal pictures
  double rms = 0.0;   // of red, green and blue
};

struct LitFigure {
  double alpha = 0.0;                   // of the source
  double target_alpha = 0.0;            // canonical
  std::vector<double> target_specular;  // in the fit's unit
  bool in_domain = true;                // of the fit
  LitSimilarity copied, converted;
};

struct LitPreview {
  std::vector<double> specular;    // of the source, as rendered
  std::vector<LitFigure> figures;  // by alpha
  Image sheet;  // a row for each alpha; columns: source, numbers copied, numbers converted; a margin of a
                // twentieth of the resolution around each picture
};

// The built-in environment of this name (sky, overcast, studio), or the one of this file; its mean luminance
// becomes `exposure` (> 0). Throws kUsage, and kInput as load_environment does.
Environment environment_for_preview(const std::string& name_or_file, double exposure);

// Both models of `fit` must be lobes of the built-in renderer with a scale or F0: throws kUsage otherwise,
// and for values out of range.
LitPreview make_lit_preview(const remap::Fit& fit, const Environment& environment,
                            const LitPreviewOptions& options);

}  // namespace remapc
