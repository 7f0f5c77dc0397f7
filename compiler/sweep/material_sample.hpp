// A sweep over all parameters of a material at once, at random samples, matched on all color channels
// together (Sztrajman et al. 2019, section 5.2, last lines, and section 8).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "sweep/sweep.hpp"
#include "table/material_table.hpp"

namespace remapc {

// Widths of random samples start here unless a range says otherwise: below, a small picture shows little.
inline constexpr double kLeastRandomAlpha = 0.05;

struct MaterialSampleOptions : PairOptions {
  std::size_t count = 1000;
  std::uint64_t seed = 0;
  bool grey = false;                // colors have one value instead of three
  std::vector<std::string> varied;  // parameters of no role of the source that vary too
  std::map<std::string, remap::Range>
      ranges;                         // of parameters of the source, own units; missing: all it takes
  std::vector<std::string> searched;  // parameters of no role of the target that are matched too
};

// Materials uniform over the ranges, rounded to nine digits: the first rows of more samples of the same seed
// are the same. Each is matched by the joint match from the source's width and four other guesses, the best
// counts. Rows hold the parameters' own units; a color has a column a channel. Light is matched as in
// run_sweep. The same table for any number of jobs. Throws as run_sweep does; nothing is kept of a run that
// is broken off but the pictures of workers in their cache.
MaterialTable run_material_sample(const Renderer& renderer, const MaterialSampleOptions& options,
                                  const SweepExecution& execution);

}  // namespace remapc
