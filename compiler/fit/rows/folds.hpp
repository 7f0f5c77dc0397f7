// Folds of cross-validation.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "table/table.hpp"

namespace remapc {

// The fold, 0 to `fold_count` - 1, in which each row judges, drawn by `seed`; the same on every machine. Rows
// of the same sample (alpha1, specular1) share a fold, so that a duplicate never judges its twin. With fewer
// samples than folds some folds are empty.
std::vector<std::size_t> draw_folds(const std::vector<TableRow>& rows, std::size_t fold_count,
                                    std::uint64_t seed);

struct Fold {
  std::vector<TableRow> training;
  std::vector<TableRow> judging;
};
Fold select_fold(const std::vector<TableRow>& rows, const std::vector<std::size_t>& fold_of_row,
                 std::size_t fold);

// `count` of `rows` (all where there are fewer), drawn by `seed`, in their order.
std::vector<TableRow> draw_rows(const std::vector<TableRow>& rows, std::size_t count, std::uint64_t seed);

// Errors, of alpha or of specular, that differ by less count as the same when the simpler of two is looked
// for: a twentieth of a step of 8 bits.
inline constexpr double kNegligibleError = 2e-4;

// Root mean square of each fold's errors, put together: over all rows, and the standard error over the folds.
struct CrossValidated {
  double rms = 0.0;
  double standard_error = 0.0;
};
CrossValidated cross_validated(const std::vector<std::vector<double>>& errors_of_folds);

}  // namespace remapc
