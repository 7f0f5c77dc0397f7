// Appearance warps after An et al. 2011: from two materials and strokes to a converter that gives the source
// the reflectance of the template. The steps, in order: features, coordinates, points, registration, table.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "warp/baselines.hpp"
#include "warp/nearest_texel.hpp"

namespace remapc {

enum class WarpMethod {
  kRegistration,  // affine from strokes, then annealed registration (registration.hpp)
  kAffine,        // of stroke centres alone
  kHistogram,     // match_histograms
  kPaper,         // warp_of_paper
};

// `registration`, `affine`, `histogram`, `paper`.
std::string_view method_name(WarpMethod method);
std::optional<WarpMethod> method_from_name(std::string_view name);
std::vector<std::string> method_names();

struct WarpOptions {
  WarpMethod method = WarpMethod::kRegistration;
  AppearanceDistance distance = AppearanceDistance::kRelative;
  int dimensions = 0;             // 1 to 3; 0: those that the materials need (dimension_of)
  double points = kWantedPoints;  // occupied bins that stand for a material, about
  std::size_t nodes = 0;          // of the table along each dimension; 0: default_nodes()
  bool exact = false;             // results are texels of the template as they are, no blends
};

// What a user can act on.
struct WarpDiagnostics {
  int source_dimensions = 0, target_dimensions = 0;  // that each material needs by itself
  int dimensions = 0;                                // of the warp
  double source_stress = 0.0, target_stress = 0.0;   // at `dimensions`
  double coordinates_error = 0.0;                    // Placement::fit_error, the larger one; radii
  int fixed_directions = 0;  // of `dimensions`, by strokes; the others follow the prior of common axes
  double fold_share = 0.0;   // of the source's texels
  double coverage = 0.0;     // share of the template's occupied bins that the result uses
  double stroke_distance =
      0.0;  // RMS, image of a source stroke's centre to the template stroke's; template radii
  double stroke_contradiction = 0.0;  // RMS, the same after the affine map of the strokes alone
  std::size_t worst_stroke = 0;       // index of the stroke that is farthest off
  std::vector<std::string> strokes;   // their names, for messages
  std::size_t source_left_out = 0, target_left_out = 0;  // texels that are not finite
  // The stroke of which another one covers most, over both materials.
  struct SharedStroke {
    std::size_t stroke = 0;  // index
    Overlap overlap;
    bool in_template = false;
  } shared;
};

// Where texels of both materials lie, and which place of the template a place of the source means.
struct AppearanceMatch {
  WarpDiagnostics diagnostics;
  Placement source, target;
  AppearanceWarp warp;         // between the two spaces
  double target_radius = 0.0;  // RMS spread of the template, in features
};

// Deterministic, on one thread. Of more than 2^16 texels of the source and 2^18 of the template as many,
// evenly spread, stand for all (besides those of strokes). Throws as require_valid(), appearance_features()
// and appearance_space() do; kUsage for dimensions or nodes out of range.
AppearanceMatch match_appearances(const MaterialRef& source, const MaterialRef& target,
                                  const std::vector<StrokePair>& strokes, const WarpOptions& options = {});

// A match of parameters, compiled.
struct WarpFit : AppearanceMatch {
  remap::CompiledWarp compiled;
  const remap::AppearanceCoordinates& target_coordinates() const {
    return std::get<remap::AppearanceCoordinates>(target.coordinates);
  }
};

// 0.12 s for 512^2 texels in two dimensions, 0.14 s in three.
WarpFit fit_warp(const WarpMaterial& source, const WarpMaterial& target,
                 const std::vector<StrokePair>& strokes, const WarpOptions& options = {});

// For every texel of the source the texel of the template that is nearest to its image (verification,
// `--copy`). A texel that takes no part gets kNoTexel.
inline constexpr std::uint32_t kNoTexel = ~std::uint32_t{0};
std::vector<std::uint32_t> copy_exactly(const AppearanceMatch& match, const MaterialRef& source,
                                        const MaterialRef& target);

// Warnings for a person, one line each, without place: what the diagnostics say that should be acted on.
std::vector<std::string> warnings_of(const WarpDiagnostics& diagnostics);

}  // namespace remapc
