// This file makes the folds of cross-validation.
#pragma once

#include <cstdint>
#include <vector>

#include "table/table.hpp"

namespace remap {

// Assigns each row to the fold, 0 to `fold_count` - 1, in which it is held out. The result depends only on
// `seed`, not on the machine. Rows of the same sample (alpha1, specular1) share a fold, so that no row is
// tested on its duplicate. If there are fewer samples than folds, some folds are empty.
std::vector<std::size_t> draw_folds(const std::vector<TableRow>& rows, std::size_t fold_count,
                                    std::uint64_t seed);

struct Fold {
  std::vector<TableRow> training;
  std::vector<TableRow> judging;
};
std::vector<Fold> split_folds(const std::vector<TableRow>& rows, std::size_t fold_count, std::uint64_t seed);

// Draws `count` of `rows` (all if there are fewer) by `seed` and keeps their order.
std::vector<TableRow> draw_rows(const std::vector<TableRow>& rows, std::size_t count, std::uint64_t seed);

}  // namespace remap
