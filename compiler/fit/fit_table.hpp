// This file fits a table: split of the rows, regression, errors on the held-out rows, provenance.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "fit/kinds.hpp"
#include "lower/fit.hpp"
#include "table/table.hpp"

namespace remap {

// A FittedTable is a fit and the fits of the same table that it was compared with, for plots.
struct FittedTable {
  Fit fit;
  std::vector<Fit> compared;  // includes `fit`, in the order of fit.candidates; empty without a comparison
};

// Fits `table`. `bytes` is its file, whose SHA-256 the fit records. Throws kInput if the table does not name
// its models or cannot be fitted (require_fittable), kUsage for an invalid id, and the errors of the
// regression. The result does not depend on the number of jobs.
FittedTable fit_table(const Table& table, std::string_view bytes, const FitOptions& options,
                      const FitProgress& progress = {});

// A RowErrors holds absolute errors of `fit` in target alpha and target specular over rows.
struct RowErrors {
  ErrorFigures alpha;
  ErrorFigures specular;
};
RowErrors row_errors(const Fit& fit, const std::vector<TableRow>& rows);

}  // namespace remap
