// How near appearance warps come to a known answer: methods side by side, one against more dimensions, coarse
// against fine sampling, and strokes that move (An et al. 2011, figures 2, 3 and 7).
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/warp_measures.hpp"

namespace remapc {

// What is varied, and what the plain registration is compared with.
enum class WarpGroup {
  kMethod,      // also copying the nearest texel without a warp, and the nearest texel to the truth
  kDimensions,  // of the registration's appearance spaces, 1 to 3 (figure 2)
  kPoints,      // occupied bins that stand for a material (figure 3)
  kNodes,       // of the compiled table along each dimension (figure 3)
};
std::string group_name(WarpGroup group);  // method, dimensions, points, nodes

struct WarpVariant {
  WarpGroup group = WarpGroup::kMethod;
  std::string name;
  std::optional<WarpMethod> method;  // none: a copy without a warp
  int dimensions = 0;                // 0: those that the materials need
  double points = kWantedPoints;
  double nodes = 1.0;  // times default_nodes()
};

// Methods first, `registration` before all; `truth` and `nearest` are the copies without a warp.
std::vector<WarpVariant> warp_variants();

struct WarpsOptions {
  std::vector<WarpCase> cases;
  unsigned jobs = 0;               // threads; 0: one a core. Figures but times do not depend on it
  bool pictures = false;           // keep what each variant gives each texel
  std::function<void()> progress;  // one of progress_steps() is done; from any thread
  const std::atomic<bool>* cancelled = nullptr;  // stops soon; throws kInterrupted
};
std::size_t progress_steps(const WarpsOptions& options);

// What only a warp has.
struct WarpCost {
  int dimensions = 0;
  double folds = 0.0;  // of the source's texels, %
  CompiledFigures compiled;
  double bytes = 0.0;    // of the compiled converter
  double seconds = 0.0;  // of processor time, from texels to the compiled converter
};

// One variant with one set of strokes. Variants of nodes have the figures of the registration, whose exact
// copy they share.
struct WarpRow {
  std::size_t set = 0, stroke_set = 0, variant = 0;  // indices
  WarpFigures figures;
  std::optional<WarpCost> cost;
  // Empty unless pictures are wanted.
  TexelCopy copy;
  std::vector<remap::WarpTexel> converted;  // by the compiled converter; nodes and the first strokes only
};

// The mean distance between the results of two sets of strokes, %.
struct StrokeChange {
  std::size_t set = 0, variant = 0;   // indices
  std::size_t first = 0, second = 0;  // sets of strokes
  double change = 0.0;
};

struct WarpsResult {
  std::vector<WarpVariant> variants;
  std::vector<WarpRow> rows;          // by set, by set of strokes, by variant
  std::vector<StrokeChange> changes;  // of variants with a warp but those of nodes
};

// Throws kUsage where there is no case, kInput as fit_warp() does, kInterrupted.
WarpsResult study_warps(const WarpsOptions& options);

// Means over rows: of one variant, over all sets or one.
struct WarpSummary {
  WarpFigures figures;
  std::optional<WarpCost> cost;
  std::optional<double> change;  // none with one set of strokes, or without a warp
};
WarpSummary summary_of(const WarpsResult& result, std::size_t variant, std::optional<std::size_t> set = {});

// The index of a variant that warp_variants() has.
std::size_t variant_named(const WarpsResult& result, WarpGroup group, const std::string& name);

}  // namespace remapc
