// This file chooses the hyper-parameters of one output by cross-validation. The stages are a coarse grid over
// the kernel, a pattern search around its best point, the choice of the smoothest equivalent kernel, and a
// search for the width of the tube.
#pragma once

#include <cstdint>

#include "fit/svr/svm_training.hpp"
#include "table/regression.hpp"

namespace remap {

struct SvrChoice {
  SvrHyperParameters parameters;
  double rms = 0.0;                 // error of cross-validation, in normalised units
  std::size_t fold_count = 0;       // 0: too few samples; `parameters` are the defaults
  std::size_t candidate_count = 0;  // number of candidates, including unfinished ones
  std::size_t sample_count = 0;     // number of samples that the last stage used
};

// Searches `samples`, sorted by alpha, then specular, without duplicate inputs. It does not search fewer than
// 8 samples.
//
// It uses five folds, drawn by `seed` so that each fold covers every section of the table. If alpha is the
// only input, the first and the last sample are always in the training set, because they bound the data. A
// candidate whose first two folds are far worse than the best is not finished. Among the candidates within
// one standard error of the best, the smallest gamma is chosen (one-standard-error rule, Breiman et al.
// 1984), because smoother mappings compile into smaller headers. Early stopping depends on counts, not on
// time, and results are combined in a fixed order. So the result does not depend on `jobs` (threads; 0: one
// per core).
//
// Throws kNumeric if no candidate converges, and the exceptions of `progress`.
SvrChoice search_hyper_parameters(const Samples& samples, std::uint64_t seed, unsigned jobs,
                                  const FitProgress& progress);

// Draws `count` of `samples`, or all if there are fewer. It takes one sample by `seed` from each of `count`
// equal sections of the list, so that a sorted list stays covered.
Samples draw_evenly(const Samples& samples, std::size_t count, std::uint64_t seed);

}  // namespace remap
