// The reach study: how much nearer to the source's picture the target could come than a converter brings it,
// over the whole range of both parameters.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "lower/fit.hpp"
#include "renderer/renderer.hpp"

namespace remap {

struct ReachOptions {
  std::vector<Fit> fits;           // between models that the renderer has
  std::vector<Range> speculars;    // of the sources, canonical, a range a fit; empty: their whole ranges
  std::size_t materials = 32;      // of each parameter: their product is compared
  Range alphas{0.05, 1.0};         // of the source; narrower highlights need more pixels
  int resolution = 192;            // width and height of the pictures in pixels
  unsigned jobs = 0;               // threads; 0: one per core. Results do not depend on it
  std::function<void()> progress;  // called progress_steps() times, from any thread
  const std::atomic<bool>* cancelled = nullptr;
};

std::size_t progress_steps(const ReachOptions& options);

// One source material. Errors are those of the pictures, relative to the source's, as the objective of the
// fit's table weighs them.
struct ReachedMaterial {
  double alpha = 0.0, specular = 0.0;                // of the source
  double target_alpha = 0.0, target_specular = 0.0;  // by the converter
  double error = 0.0;                                // of those
  double least_alpha = 0.0, least_specular = 0.0;    // the best that the target can do
  double least_error = 0.0;
  double excess() const { return error - least_error; }
};

// Renders every material, its conversion (by the interpreter, with the domain rule), and the target at widths
// a hundredth apart, each at its best specular in closed form. No search of a sweep takes part. Throws kUsage
// for models that the renderer does not have, kInput for a fit whose table does not name its objective and
// for a target without a family (specular_response.hpp), and kInterrupted.
// Returns the materials of each fit.
std::vector<std::vector<ReachedMaterial>> study_reach(const Renderer& renderer, const ReachOptions& options);

// A row for each material, by fits in their order.
std::string reach_csv(const ReachOptions& options, const std::vector<std::vector<ReachedMaterial>>& result);

}  // namespace remap
