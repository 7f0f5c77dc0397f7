// This file matches every sample of the source's parameters and returns the table.
#pragma once

#include <string>
#include <vector>

#include "measure/sweep_options.hpp"
#include "table/table.hpp"

namespace remap {

// Returns a grid of samples, rounded to nine digits. It has `alpha_count` widths over `alphas`, both ends
// included, and for each width `specular_count` values over `speculars`. A lower end of 0 is omitted, because
// nothing can be matched there. The paper uses 30 x 30 (section 5.2).
std::vector<MappedTexel> grid_samples(const Range& alphas, std::size_t alpha_count, const Range& speculars,
                                      std::size_t specular_count);

// Describes this grid in words, for SweepOptions::sampling.
std::string grid_text(const Range& alphas, std::size_t alpha_count, const Range& speculars,
                      std::size_t specular_count);

// Returns the law of the specular of `model` (probe_specular), from small pictures with alpha from 0.1.
SpecularResponse specular_response(const Renderer& renderer, const ModelDescription& model);

// Returns the range of canonical speculars that `model` accepts, by the law of specular_response().
Range canonical_speculars(const Renderer& renderer, const ModelDescription& model);

// Matches every sample. With two stages, width and specular come from pictures without diffuse, and diffuse
// is matched afterwards. With one stage, all three are matched at once, from kFixedGuess (joint_match.hpp).
// With three stages, all are matched at once, from the result of two stages. If the light of the two models
// differs by a factor, the source's pictures are first multiplied by it (section 4). The table does not
// depend on the number of jobs. Throws kUsage for unknown models and samples out of range, kNumeric if a
// search fails, and the renderer's errors.
Table run_sweep(const Renderer& renderer, const SweepOptions& options, const SweepExecution& execution);

}  // namespace remap
