// This file is the reach study. A converter brings the target's picture close to the source's. The study
// measures how much closer it could come, over the whole range of both parameters.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "lower/fit.hpp"
#include "renderer/renderer.hpp"

namespace remap {

struct ReachOptions {
  std::vector<Fit> fits;  // between models that the renderer has
  // Canonical ranges of specular, one for the source of each fit. If empty, whole ranges are used.
  std::vector<Range> speculars;
  std::size_t materials = 32;      // number of values of each parameter, all of which are combined
  Range alphas{0.05, 1.0};         // range of the source; narrower highlights need more pixels
  int resolution = 192;            // width and height of the pictures in pixels
  unsigned jobs = 0;               // threads; 0: one per core. Results do not depend on it
  std::function<void()> progress;  // called progress_steps() times, from any thread
  const std::atomic<bool>* cancelled = nullptr;
};

std::size_t progress_steps(const ReachOptions& options);

// A ReachedMaterial is one source material. Errors are differences of pictures, relative to the source's,
// with the weights of the objective in the fit's table.
struct ReachedMaterial {
  double alpha = 0.0, specular = 0.0;                // the source's parameters
  double target_alpha = 0.0, target_specular = 0.0;  // converted parameters
  double error = 0.0;                                // error of the converter's result
  double least_alpha = 0.0, least_specular = 0.0;    // the target's best parameters
  double least_error = 0.0;
  double excess() const { return error - least_error; }
};

// Renders every material and its conversion (by the interpreter, with the domain rule). Also renders the
// target at widths that are 1 % apart, each with its best specular, which a formula gives. It does not use
// the search of a sweep. Throws kUsage for models that the renderer lacks, and kInterrupted. Throws kInput
// for a fit whose table does not name its objective, and for a target without a family
// (specular_response.hpp). Returns the materials of each fit.
std::vector<std::vector<ReachedMaterial>> study_reach(const Renderer& renderer, const ReachOptions& options);

// Returns a row for each material, in the order of the fits.
std::string reach_csv(const ReachOptions& options, const std::vector<std::vector<ReachedMaterial>>& result);

}  // namespace remap
