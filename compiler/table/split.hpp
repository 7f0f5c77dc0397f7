// This file splits rows into training rows and held-out rows, and computes the error figures over rows.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "lower/fit.hpp"
#include "table/table.hpp"

namespace remap {

// Returns a random permutation of `count` indices that depends only on `seed`, not on the machine. The first
// indices are held out.
std::vector<std::size_t> seeded_order(std::size_t count, std::uint64_t seed);

// Returns the record of a split of `rows` rows, of which `fraction` (rounded) are held out. Throws kUsage for
// a fraction outside [0, 0.9].
Split split_record(std::uint64_t seed, double fraction, std::size_t rows);

struct RowSplit {
  std::vector<TableRow> training;
  std::vector<TableRow> held_out;
  Split record;
};

// Splits the rows in `domain` that have an answer. It holds out `held_out_fraction` of them (rounded), drawn
// by `seed`. Other rows are counted by their status, or as `beyond the domain`. The split does not depend on
// the machine. Throws kUsage for a fraction outside [0, 0.9].
RowSplit split_rows(const Table& table, const Domain& domain, std::uint64_t seed, double held_out_fraction);

// Returns the rows whose target is at no limit.
std::vector<TableRow> inside_rows(const std::vector<TableRow>& rows);

// A Residuals holds errors of target alpha and target specular, one per row. A fit, or `map`, gives the
// target's alpha and specular for the source's.
struct Residuals {
  std::vector<double> alpha, specular;
};
Residuals residuals_of(const std::vector<TableRow>& rows, const Fit& fit);
Residuals residuals_of(const std::vector<TableRow>& rows,
                       const std::function<MappedTexel(double alpha, double specular)>& map);
Residuals residuals_of(const std::vector<TableRow>& rows, const MappingKind& mapping);

// Returns RMS, 99th percentile (closest rank) and maximum of absolute values. All are zero for an empty list.
ErrorFigures error_figures(std::vector<double> errors);

// Formats an error with two significant digits, rounded up in magnitude: `7.2e-04`, or `0` for 0.
std::string error_text(double error);

// Draws `count` of `rows` (all if there are fewer) by `seed` and keeps their order.
std::vector<TableRow> draw_rows(const std::vector<TableRow>& rows, std::size_t count, std::uint64_t seed);

}  // namespace remap
