// Which rows train and which judge, and how the judges' verdict is put in figures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/fit.hpp"
#include "table/table.hpp"

namespace remapc {

struct RowSplit {
  std::vector<TableRow> training;
  std::vector<TableRow> held_out;
  remap::Split record;
};

// Rows of status ok in `domain`, `held_out_fraction` of them (rounded) drawn by `seed` and kept apart; others
// are counted by their status, or as `beyond the domain`. The same split on every machine. Throws kUsage for
// a fraction outside [0, 0.9].
RowSplit split_rows(const Table& table, const remap::Domain& domain, std::uint64_t seed,
                    double held_out_fraction);

// Root mean square, 99th percentile (nearest rank) and largest of absolute values. Zeros for none.
remap::ErrorFigures error_figures(std::vector<double> errors);

// An error as people compare it: two significant digits, rounded away from 0, always as `7.2e-04`; `0` for 0.
std::string error_text(double error);

}  // namespace remapc
