// This file samples all parameters of a material at once, at random, and matches all color channels together
// (Sztrajman et al. 2019, section 5.2, last lines, and section 8).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "measure/sweep.hpp"
#include "table/table.hpp"

namespace remap {

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
