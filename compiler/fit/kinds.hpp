// The kinds of fits, each a folder: its regression in one line of the list.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "fit/network/mlp.hpp"
#include "table/regression.hpp"

namespace remap {

struct RegressionOptions {
  std::uint64_t seed = 1;
  unsigned jobs = 0;  // threads; 0: one per core. Results do not depend on it
  std::string form;   // of the parametric kind; empty: that of the paper
  MlpOptions mlp;     // its seed and jobs are ignored in favor of those above
};

// The regressions that a user can name, of the rows below the limits of the target. Without a name forms are
// compared (comparison.hpp).
struct FitKind {
  std::string_view name;
  // `domain`: in which curves must be sound. Throws the errors of the regression.
  Regression (*fit)(const std::vector<TableRow>& rows, const Domain& domain, const RegressionOptions& options,
                    const FitProgress& progress);
};

extern const std::array<FitKind, 3> kFitKinds;

// Throws kUsage for a name that is not in the list.
const FitKind& fit_kind(std::string_view name);

}  // namespace remap
