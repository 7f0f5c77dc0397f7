// Fits the regimes of a table (remap/regimes.hpp), each on its own rows.
#pragma once

#include <vector>

#include "fit/network/mlp.hpp"
#include "table/row_regime.hpp"

namespace remapc {

// Training rows by regime. A regime of too few rows or widths to be fitted has none, and is left to the mapping, which
// is cut off at the limit.
struct RegimeRows {
  // Rows inside, and some that continue them beyond the limits, extrapolated from their neighbours: they make the
  // mapping pass a limit where the table does.
  std::vector<TableRow> inside;
  std::vector<TableRow> wide;    // continued where specular is at its limit, too
  std::vector<TableRow> bright;
};
RegimeRows regime_rows(const std::vector<TableRow>& training, const TargetLimits& limits);

// Fits a small network to each regime that has rows, for a `mapping` of rows.inside. At the joints, the mapping gives
// further rows. `domain`: that of the fit. `method` receives the hyper-parameters of each network. Throws the errors
// of train_network().
remap::Regimes fit_regimes(const RegimeRows& rows, const TargetLimits& limits, const remap::MappingKind& mapping,
                           const remap::Domain& domain, const MlpOptions& options,
                           std::map<std::string, std::string>* method, const FitProgress& progress = {});

}  // namespace remapc
