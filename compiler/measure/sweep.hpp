// This file matches every sample of the source's parameters and returns the table: of a grid over width and
// specular, or of random values of all parameters, with all color channels matched together
// (material_sample.cpp; Sztrajman et al. 2019, section 5.2, last lines, and section 8).
#pragma once

#include <cstdint>
#include <map>
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
// is matched afterwards. With one stage, all three are matched at once, from kFixedGuess (match.hpp).
// With three stages, all are matched at once, from the result of two stages. If the light of the two models
// differs by a factor, the source's pictures are first multiplied by it (section 4). The table does not
// depend on the number of jobs. Throws kUsage for unknown models and samples out of range, kNumeric if a
// search fails, and the renderer's errors.
Table run_sweep(const Renderer& renderer, const SweepOptions& options, const SweepExecution& execution);

// Random widths start here by default, because a small picture does not resolve narrower highlights.
inline constexpr double kLeastRandomAlpha = 0.05;

struct MaterialSampleOptions : PairOptions {
  std::size_t count = 1000;
  std::uint64_t seed = 0;
  bool grey = false;                // colors get one value instead of three
  std::vector<std::string> varied;  // source parameters without a role that vary, too
  // Ranges of source parameters, in their own units. A parameter that is missing here has its whole range.
  std::map<std::string, Range> ranges;
  std::vector<std::string> searched;  // target parameters without a role that are matched, too
};

// Draws materials uniformly from the ranges, rounded to nine digits. Matches each material by the joint
// match, from the source's width and from four other guesses, and keeps the best result. With the same seed,
// a larger count starts with the same rows. Rows hold parameters in their own units. A color has a column for
// each channel. Light is matched as in run_sweep(). The table does not depend on the number of jobs. Throws
// like run_sweep(). After an interruption, only the pictures in the workers' cache remain.
MaterialTable run_material_sample(const Renderer& renderer, const MaterialSampleOptions& options,
                                  const SweepExecution& execution);

}  // namespace remap
