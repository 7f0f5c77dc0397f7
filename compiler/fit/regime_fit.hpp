// Fits the regimes of a table (remap/regimes.hpp), each on its own rows.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "table/regression.hpp"
#include "table/table.hpp"

namespace remap {

// Training rows by regime. A regime of too few rows or widths to be fitted has none, and is left to the
// mapping, which is cut off at the limit.
struct RegimeRows {
  // Rows inside, and some that continue them beyond the limits, extrapolated from their neighbours: they make
  // the mapping pass a limit where the table does.
  std::vector<TableRow> inside;
  std::vector<TableRow> wide;  // continued where specular is at its limit, too
  std::vector<TableRow> bright;
};
// `all`: the rows of the table, from whose neighbours the training rows are continued.
RegimeRows regime_rows(const std::vector<TableRow>& training, const std::vector<TableRow>& all);

// Fits a series to each regime that has rows, for a `mapping` of rows.inside. Where regimes meet, the mapping
// gives further rows. `domain`: that of the fit. The degree is chosen by cross-validation, whose folds depend
// on `seed`. `method` receives it.
Regimes fit_regimes(const RegimeRows& rows, const TargetLimits& limits, const MappingKind& mapping,
                    const Domain& domain, std::uint64_t seed, std::map<std::string, std::string>* method);

}  // namespace remap
