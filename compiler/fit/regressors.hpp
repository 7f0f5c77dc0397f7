// A common interface of all regressions: fit rows, and refit other rows with the same hyper-parameters.
#pragma once

#include <cstdint>
#include <string>

#include "fit/network/mlp.hpp"
#include "fit/rows/regression.hpp"
#include "fit/svr/svr.hpp"

namespace remapc {

enum class Regressor { kParametric, kSvr, kMlp, kSeries };

struct RegressionOptions {
  std::uint64_t seed = 1;
  unsigned jobs = 0;  // threads; 0: one per core. Results do not depend on it
  std::string form;   // of the parametric kind; empty: chosen
  SvrOptions svr;     // its seed and jobs are ignored in favor of those above
  MlpOptions mlp;     // its seed and jobs are ignored, too
};

// Fits `rows`. `domain`: the range in which curves must be sound. Throws the errors of the regression.
Regression regress(Regressor regressor, const std::vector<TableRow>& rows, const remap::Domain& domain,
                   const RegressionOptions& options, const FitProgress& progress = {});

// Fits other rows with the form, hyper-parameters and layers of `model`, without a search. Does not check
// whether curves are sound.
remap::MappingKind regress_again(const Regression& model, const std::vector<TableRow>& rows,
                                 const RegressionOptions& options);

// The bounding box of rows. Specular starts at 0.
remap::Domain covered_domain(const std::vector<TableRow>& rows);

}  // namespace remapc
