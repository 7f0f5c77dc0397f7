// The choice of the hyper-parameters of one output by cross-validation: a coarse grid over the shape of the
// kernel, a pattern search around its best, the smoothest of what is as good, the width of the tube.
#pragma once

#include <cstdint>

#include "fit/rows/regression.hpp"
#include "fit/svr/svm_training.hpp"
#include "fit/svr/svr_options.hpp"

namespace remapc {

struct SvrSearchOptions {
  std::uint64_t seed = 1;
  unsigned jobs = 0;  // threads; 0: one a processor. The result does not depend on it
};

struct SvrChoice {
  SvrHyperParameters parameters;
  double rms = 0.0;                 // of cross-validation, in normalised units
  std::size_t fold_count = 0;       // 0: too few samples, `parameters` are the defaults
  std::size_t candidate_count = 0;  // that were tried, the hopeless ones among them
  std::size_t sample_count = 0;     // that the last stage saw
};

// `samples`: sorted by alpha, then specular, no two with the same inputs. Fewer than 8
// are not searched.
//
// Five folds, drawn by `seed` so that each holds its share of every stretch of the table; where alpha is the
// only input the first and the last sample always train, since beyond them is nothing to learn from. A
// candidate whose first two folds are far behind the best is not finished. Among those within one standard
// error of the best the smallest gamma wins (Breiman et al. 1984, the one-standard-error rule), since
// smoother mappings compile into smaller headers. Work that decides nothing is saved by counts only, never by
// time, and results are put together in a fixed order: the same answer for any number of threads.
//
// Throws what `progress` throws, and kNumeric where no candidate converges.
SvrChoice search_hyper_parameters(const SvrSamples& samples, const SvrSearchOptions& options,
                                  const FitProgress& progress);

// `count` samples of `samples` (all where there are fewer): the list is cut into `count` stretches, one is
// drawn from each by `seed`, so that a sorted list keeps its coverage.
SvrSamples draw_evenly(const SvrSamples& samples, std::size_t count, std::uint64_t seed);

}  // namespace remapc
