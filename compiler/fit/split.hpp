// Which rows train and which judge, and how the judges' verdict is put in figures.
#pragma once

#include <cstdint>
#include <vector>

#include "model/fit.hpp"
#include "table/table.hpp"

namespace remapc {

struct RowSplit {
  std::vector<TableRow> training;
  std::vector<TableRow> held_out;
  remap::Split record;
};

// Rows of status ok, `held_out_fraction` of them (rounded) drawn by `seed` and kept apart. The same split on
// every machine. Throws kUsage for a fraction outside [0, 0.9].
RowSplit split_rows(const Table& table, std::uint64_t seed, double held_out_fraction);

// Root mean square, 99th percentile (nearest rank) and largest of absolute values. Zeros for none.
remap::ErrorFigures error_figures(std::vector<double> errors);

}  // namespace remapc
