// The sweep: every sample of the source's parameters matched, into a table.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sweep/sweep_options.hpp"
#include "table/table.hpp"

namespace remapc {

// Uniform samples: `alpha_count` widths over `alphas`, both ends included, and `specular_count` values over
// `speculars`, the lower end excluded where it is 0 (nothing to match there), rounded to nine digits.
// Section 5.2 takes 30 x 30.
std::vector<SamplePoint> grid_samples(const remap::Range& alphas, std::size_t alpha_count,
                                      const remap::Range& speculars, std::size_t specular_count);

// The same in words, for SweepOptions::sampling.
std::string grid_text(const remap::Range& alphas, std::size_t alpha_count, const remap::Range& speculars,
                      std::size_t specular_count);

// The law of the specular of `model` (probe_specular), from small pictures of widths from 0.1.
SpecularResponse specular_response(const Renderer& renderer, const ModelDescription& model);

// Canonical speculars that `model` takes, by the law that a few small pictures show (probe_specular).
remap::Range canonical_speculars(const Renderer& renderer, const ModelDescription& model);

// Matches every sample. Stages 2: width and specular from pictures without diffuse, diffuse apart from them.
// Stages 1: width, specular and diffuse at once from kFixedGuess (joint_match.hpp); 3: the same from the
// result of 2. Where the two models' light differs by a factor, the source's pictures are multiplied by it
// first (section 4). The same table for any number of jobs. Throws kUsage for unknown models and samples out
// of range, kNumeric where a search breaks, and what the renderer throws.
Table run_sweep(const Renderer& renderer, const SweepOptions& options, const SweepExecution& execution);

}  // namespace remapc
