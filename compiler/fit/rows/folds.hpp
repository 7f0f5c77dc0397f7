// Folds of cross-validation.
#pragma once

#include <cstdint>
#include <vector>

#include "table/table.hpp"

namespace remapc {

// Assigns each row to the fold, 0 to `fold_count` - 1, in which it is held out. The result depends only on
// `seed`, not on the machine. Rows of the same sample (alpha1, specular1) share a fold, so that no row is
// tested on its duplicate. If there are fewer samples than folds, some folds are empty.
std::vector<std::size_t> draw_folds(const std::vector<TableRow>& rows, std::size_t fold_count,
                                    std::uint64_t seed);

struct Fold {
  std::vector<TableRow> training;
  std::vector<TableRow> judging;
};
// The rows of each fold of draw_folds().
std::vector<Fold> split_folds(const std::vector<TableRow>& rows, std::size_t fold_count, std::uint64_t seed);

// Draws `count` of `rows` (all if there are fewer) by `seed` and keeps their order.
std::vector<TableRow> draw_rows(const std::vector<TableRow>& rows, std::size_t count, std::uint64_t seed);

// Errors of alpha or specular that differ by less count as equal when the simpler of two fits is chosen. It
// is a twentieth of an 8-bit step.
inline constexpr double kNegligibleError = 2e-4;

// The RMS error over all rows, and its standard error over the folds. Infinite for a fit that failed.
struct CrossValidated {
  double rms = 0.0;
  double standard_error = 0.0;
};
CrossValidated cross_validated(const std::vector<std::vector<double>>& errors_of_folds);

// The error up to which a fit counts as equal to the best of `scores`: one standard error (Breiman et al.
// 1984), but at least kNegligibleError, above that of the best.
double error_bound(const std::vector<CrossValidated>& scores);

}  // namespace remapc
