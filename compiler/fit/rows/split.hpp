// Which rows train and which judge, and how the judges' verdict is put in figures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/fit.hpp"
#include "table/table.hpp"

namespace remapc {

// The places of `count` rows in an order of that seed, the same on every machine: the first of it judge.
std::vector<std::size_t> seeded_order(std::size_t count, std::uint64_t seed);
// Throws kUsage for a share of judges outside [0, 0.9].
void require_held_out_share(double fraction);
std::size_t held_out_count(double fraction, std::size_t rows);

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
