// The warps study: the error of appearance warps on sets with a known result, by method, dimension, sampling
// and set of strokes (An et al. 2011, figures 2, 3 and 7).
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/warp_measures.hpp"

namespace remapc {

// The property in which a variant differs from the default registration.
enum class WarpGroup {
  kMethod,      // includes copies of the nearest texel without a warp and of the texel nearest to the truth
  kDimensions,  // of the appearance spaces, 1 to 3 (figure 2)
  kPoints,      // occupied bins that represent a material (figure 3)
  kNodes,       // of the compiled table along each dimension (figure 3)
};
std::string group_name(WarpGroup group);  // method, dimensions, points, nodes

struct WarpVariant {
  WarpGroup group = WarpGroup::kMethod;
  std::string name;
  std::optional<WarpMethod> method;  // empty: a copy without a warp
  int dimensions = 0;                // 0: as many as the materials need
  double points = kWantedPoints;
  double nodes = 1.0;  // factor of default_nodes()
};

// All variants, methods first. The first is `registration`; `truth` and `nearest` are copies without a warp.
std::vector<WarpVariant> warp_variants();

struct WarpsOptions {
  std::vector<WarpCase> cases;
  unsigned jobs = 0;                             // threads; 0: one per core. Affects only times
  bool pictures = false;                         // keep the results of each variant
  std::function<void()> progress;                // called progress_steps() times, from any thread
  const std::atomic<bool>* cancelled = nullptr;  // set to true to stop; throws kInterrupted
};
std::size_t progress_steps(const WarpsOptions& options);

// Figures of variants with a warp.
struct WarpCost {
  int dimensions = 0;
  double folds = 0.0;  // share of source texels where the warp folds, %
  CompiledFigures compiled;
  double bytes = 0.0;    // size of the compiled converter
  double seconds = 0.0;  // processor time from texels to the compiled converter
};

// One variant with one set of strokes. Variants of kNodes have the figures of the registration, because they
// share its exact copy.
struct WarpRow {
  std::size_t set = 0, stroke_set = 0, variant = 0;  // indices
  WarpFigures figures;
  std::optional<WarpCost> cost;
  // Empty without WarpsOptions::pictures.
  TexelCopy copy;
  std::vector<remap::WarpTexel>
      converted;  // by the compiled converter; only for kNodes and the first strokes
};

// The mean distance between the results of two sets of strokes, %.
struct StrokeChange {
  std::size_t set = 0, variant = 0;   // indices
  std::size_t first = 0, second = 0;  // sets of strokes
  double change = 0.0;
};

struct WarpsResult {
  std::vector<WarpVariant> variants;
  std::vector<WarpRow> rows;          // by set, set of strokes, variant
  std::vector<StrokeChange> changes;  // of variants with a warp, except kNodes
};

// Runs the study. Throws kUsage without a case, the errors of fit_warp(), and kInterrupted.
WarpsResult study_warps(const WarpsOptions& options);

// Means over the rows of one variant, over all sets or one set.
struct WarpSummary {
  WarpFigures figures;
  std::optional<WarpCost> cost;
  std::optional<double> change;  // empty with one set of strokes or without a warp
};
WarpSummary summary_of(const WarpsResult& result, std::size_t variant, std::optional<std::size_t> set = {});

// The index of a variant of warp_variants().
std::size_t variant_named(const WarpsResult& result, WarpGroup group, const std::string& name);

}  // namespace remapc
