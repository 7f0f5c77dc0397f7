// The samples of one source width, matched: the unit of work of a sweep.
#pragma once

#include <memory>
#include <vector>

#include "match/target_bank.hpp"
#include "match/target_grid.hpp"
#include "match/target_pictures.hpp"
#include "sweep/sweep_options.hpp"
#include "table/table.hpp"

namespace remapc {

// Samples of one source width, as indices into SweepOptions::samples: the unit of work.
struct SampleBlock {
  double alpha;
  std::vector<std::size_t> samples;
};

// Everything that the blocks of one sweep share.
struct SweepSetup {
  const SweepOptions& options;
  const PictureTaker& picture_taker;
  ProbedModel source;
  ProbedModel target;
  double irradiance_scale = 1.0;             // what the source's pictures are multiplied by
  DiffuseMatch diffuse;                      // of the source's pictures, so multiplied
  std::unique_ptr<TargetBank> bank;          // of a target that has a family (ProbedModel::family)
  std::unique_ptr<TargetPictures> pictures;  // for non-linear matches
  std::unique_ptr<TargetGrid> grid;          // of a target that has none
  EffectiveWidths source_widths, target_widths;
};

// Whether rows carry diffuse: where the source has some, or the target's is matched with the rest.
bool has_diffuse(const SweepOptions& options);

// The rows of a block, in its order.
std::vector<TableRow> match_block(const SweepSetup& setup, const SampleBlock& block);

}  // namespace remapc
