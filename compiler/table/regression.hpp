// This file holds what every regression shares: the domain of a table, the split of rows into those to train
// on and those to judge by, errors over rows, and the result, which is a mapping and how it was found.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "lower/fit.hpp"
#include "table/table.hpp"

namespace remap {

// Returns the box with alpha1 in a range and specular1 from 0 to a bound. In this box, every width has usable
// rows up to the bound, and no other row is clamped. covered_box() chooses among such boxes. Rows of other
// statuses are gaps, which do not limit the box. Throws kInput if there is no such box.
Domain table_domain(const Table& table);

// Formats a range as `0.01 to 1`.
std::string range_text(const Range& range);

// Exchanges source and target of the table's usable rows (Sztrajman et al. 2019, section 5). Comments are
// kept, because they record how the table was made, and `roles: swapped` is added. Comments about one role
// are removed: the comparison of spheres, which lists widths of the source, and the target's limits. Widths
// of the target that differ only by the rounding of the measurement (1e-9 of the width) become one.
Table swapped(const Table& table);

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

// A Samples holds the training data: rows of `input_count` inputs and `output_count` outputs.
struct Samples {
  std::size_t input_count = 0;
  std::size_t output_count = 0;
  std::vector<double> inputs;
  std::vector<double> outputs;
  std::size_t count() const noexcept { return input_count == 0 ? 0 : inputs.size() / input_count; }
};

struct Regression {
  MappingKind mapping;
  std::map<std::string, std::string> method;  // recorded in the fit: hyper-parameters, search, starts
};

// A FitProgress is called repeatedly with the finished fraction of the work, 0 to 1, from any thread. An
// exception from it ends the regression. It may be empty.
using FitProgress = std::function<void(double share)>;

// Returns the progress for a part of the work that goes from the fraction `begin` to the fraction `end`. It
// refers to `progress`, and is empty if `progress` is empty.
FitProgress part_of(const FitProgress& progress, double begin, double end);

// Throws kInput for fewer than 10 rows, or if alpha1 or specular1 is constant. The message starts with
// `kind`.
void require_variety(const std::vector<TableRow>& rows, const std::string& kind);

// Returns true if target alpha depends on specular at the same source alpha. For each alpha1, a straight line
// over specular is fitted to alpha2. The lines must explain more than the residuals leave. If this is false,
// target alpha is fitted from source alpha only.
bool alpha_needs_specular(const std::vector<TableRow>& rows);

// Returns `id`. If it is empty, returns the id of a converter between the models. Throws kUsage for an
// invalid id.
std::string fit_id(const std::string& id, const std::string& source_model, const std::string& target_model);

}  // namespace remap
