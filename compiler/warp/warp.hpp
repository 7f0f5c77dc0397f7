// This file computes appearance warps after An et al. 2011. From two materials and strokes, it makes a
// converter that gives the source the reflectance of the template. The steps are features, coordinates,
// points, registration and table.
#pragma once

#include <string>
#include <vector>

#include "warp/registration.hpp"

namespace remap {

// A WarpDiagnostics holds figures that help a user to improve strokes.
struct WarpDiagnostics {
  int source_dimensions = 0, target_dimensions = 0;  // number of dimensions that each material needs
  int dimensions = 0;                                // number of dimensions in the warp
  double source_stress = 0.0, target_stress = 0.0;   // stress with `dimensions` dimensions
  double coordinates_error = 0.0;  // the larger Placement::fit_error of both materials, in radii
  // number of dimensions that strokes determine; the prior determines the others
  int fixed_directions = 0;
  double fold_share = 0.0;  // fraction of source texels where the warp folds
  double coverage = 0.0;    // fraction of the template's occupied bins that the result uses
  // These are RMS distances between the moved centres of the source's strokes and the centres of the
  // template's strokes, in template radii. The first is after the warp, the second after the affine map only.
  double stroke_distance = 0.0;
  double stroke_contradiction = 0.0;
  std::size_t worst_stroke = 0;                          // index of the stroke with the largest distance
  std::vector<std::string> strokes;                      // names of the strokes, for messages
  std::size_t source_left_out = 0, target_left_out = 0;  // numbers of texels that are not finite
  Overlap shared;                                        // the largest overlap in either material
};

// An AppearanceMatch holds the positions of the texels of both materials, and the warp between the positions.
struct AppearanceMatch {
  WarpDiagnostics diagnostics;
  Placement source, target;
  std::vector<std::uint32_t> target_texels;   // the texels of the template that the match used
  Points source_positions, target_positions;  // of the texels that the match used
  SmoothWarp warp;                            // from the source's to the template's space
  double target_radius = 0.0;                 // RMS spread of the template, in features
};

// Matches two materials in one thread. Equal inputs give equal results. It uses all texels of strokes, and
// other texels evenly spread: at most 2^16 of the source and 2^18 of the template. Throws the errors of
// require_valid(), appearance_features() and appearance_space().
AppearanceMatch match_appearances(const MaterialRef& source, const MaterialRef& target,
                                  const std::vector<StrokePair>& strokes,
                                  AppearanceDistance distance = AppearanceDistance::kRelative);

// A WarpFit is a match of two parametric materials with its compiled converter.
struct WarpFit : AppearanceMatch {
  CompiledWarp compiled;
  const AppearanceCoordinates& target_coordinates() const {
    return std::get<AppearanceCoordinates>(target.coordinates);
  }
};

// With `exact`, results are texels of the template, not blends. Takes 0.12 s for 512^2 texels in two
// dimensions, 0.14 s in three.
WarpFit fit_warp(const WarpMaterial& source, const WarpMaterial& target,
                 const std::vector<StrokePair>& strokes,
                 AppearanceDistance distance = AppearanceDistance::kRelative, bool exact = false);

// Returns, for every source texel, the template texel closest to its image. `--copy` and tests use this.
// Texels that are not finite get kNoTexel.
inline constexpr std::uint32_t kNoTexel = ~std::uint32_t{0};
std::vector<std::uint32_t> copy_exactly(const AppearanceMatch& match, const MaterialRef& source,
                                        const MaterialRef& target);

// Returns the RMS distance in the template's appearance space between the results of the compiled converter
// and of copy_exactly(), relative to the template's spread. Uses at most 2^14 source texels and 2^18 template
// texels, both evenly spread.
double copy_rms_error(const WarpFit& fit, const WarpMaterial& source, const WarpMaterial& target);

// Returns warnings about diagnostics that the user should act on, one line each, without the place.
std::vector<std::string> warnings_of(const WarpDiagnostics& diagnostics);

}  // namespace remap
