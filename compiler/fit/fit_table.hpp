// From a table to a fit: split, regression, errors on the rows that were held out, provenance.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "fit/regressors.hpp"
#include "model/fit.hpp"
#include "table/table.hpp"
#include "table/table_record.hpp"

namespace remapc {

struct FitOptions {
  std::string id;                      // empty: `<source>_to_<target>` from the table
  std::optional<Regressor> regressor;  // none: the one that compare_regressions() (comparison.hpp) chooses
  RegressionOptions regression;        // its seed is that of the split too
  double held_out_fraction = 0.2;
};

// A fit and the others that it was compared with, all of the same table: for plots.
struct FittedTable {
  remap::Fit fit;
  std::vector<remap::Fit> compared;  // with `fit` among them, in the order of fit.candidates; else empty
};

// Fits `table`, whose file is `bytes` (for the SHA-256 in the fit). Throws kInput where the table does not
// name its models or cannot be fitted (require_fittable), kUsage for an id that is no identifier, and what
// the regression throws. The same table and options give the same fit, whatever the number of jobs.
FittedTable fit_table(const Table& table, std::string_view bytes, const FitOptions& options,
                      const FitProgress& progress = {});

// Errors of `fit` on rows: target alpha and specular, absolute.
struct RowErrors {
  remap::ErrorFigures alpha;
  remap::ErrorFigures specular;
};
RowErrors row_errors(const remap::Fit& fit, const std::vector<TableRow>& rows);

}  // namespace remapc
