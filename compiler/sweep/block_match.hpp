// The samples of one source width, matched: the unit of work of a sweep.
#pragma once

#include <memory>
#include <vector>

#include "sweep/sweep.hpp"
#include "sweep/target_bank.hpp"
#include "sweep/target_grid.hpp"
#include "sweep/target_pictures.hpp"

namespace remapc {

// Samples of one source width, as indices into SweepOptions::samples: the unit of work and of the journal.
struct SampleBlock {
  double alpha;
  std::vector<std::size_t> samples;
};

// Everything that the blocks of one sweep share.
struct SweepSetup {
  const SweepOptions& options;
  const Photographer& photographer;
  Subject source;
  Subject target;
  double irradiance_scale = 1.0;             // what the source's pictures are multiplied by
  DiffuseMatch diffuse;                      // of the source's pictures, so multiplied
  std::unique_ptr<TargetBank> bank;          // of a target that has a family (Subject::family)
  std::unique_ptr<TargetPictures> pictures;  // for non-linear matches
  std::unique_ptr<TargetGrid> grid;          // of a target that has none
  EffectiveWidths source_widths, target_widths;
};

// Whether rows carry diffuse: where the source has some, or the target's is matched with the rest.
bool has_diffuse(const SweepOptions& options);

// The rows of a block, in its order.
std::vector<TableRow> match_block(const SweepSetup& setup, const SampleBlock& block);

}  // namespace remapc
