// This file matches the samples of one source width. A sweep distributes such blocks to threads.
#pragma once

#include <memory>
#include <vector>

#include "measure/sweep_options.hpp"
#include "measure/target_pictures.hpp"
#include "table/table.hpp"

namespace remap {

// A SampleBlock holds samples of one source width, as indices into SweepOptions::samples.
using SampleBlock = std::vector<std::size_t>;

// Samples are rounded to numbers that a user can type.
inline constexpr int kSampleDigits = 9;

// A SweepSetup holds the data that the blocks of one sweep share.
struct SweepSetup {
  const SweepOptions& options;
  const PictureTaker& picture_taker;
  ProbedModel source;
  MatchTarget target;
  double irradiance_scale = 1.0;       // multiplies the source's pictures
  DiffuseMatch diffuse;                // measured after that multiplication
  std::unique_ptr<TargetGrid> grid;    // set for a target without a family
  Range source_widths, target_widths;  // widths that change pictures (probe_widths)
  Range wanted_widths;                 // widths to search, even if they do not change the target's pictures

  LightMatch light() const { return {irradiance_scale, diffuse.error, options.accept_light}; }
  Limits limits() const { return {target_widths.max, target.linear_range().max}; }
};

// Returns true if rows have diffuse, because the source has diffuse, or because the target's diffuse is
// matched together with the rest.
bool has_diffuse(const SweepOptions& options);

// Returns the rows of a block in its order, followed by the rows at the places where the regime changes.
std::vector<TableRow> match_block(const SweepSetup& setup, const SampleBlock& block);

}  // namespace remap
