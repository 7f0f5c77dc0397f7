// The kinds of regression behind one door: by name, and once more on other rows.
#pragma once

#include <cstdint>
#include <string>

#include "fit/network/mlp.hpp"
#include "fit/rows/regression.hpp"
#include "fit/svr/svr.hpp"

namespace remapc {

enum class Regressor { kParametric, kSvr, kMlp };

struct RegressionOptions {
  std::uint64_t seed = 1;
  unsigned jobs = 0;  // threads; 0: one a processor. No result depends on it
  std::string form;   // of the parametric kind; empty: chosen
  SvrOptions svr;     // its seed and jobs are those above
  MlpOptions mlp;     // the same
};

// Regresses `rows`. `domain`: where curves have to be sound. Throws what the regression throws.
Regression regress(Regressor regressor, const std::vector<TableRow>& rows, const remap::Domain& domain,
                   const RegressionOptions& options, const FitProgress& progress = {});

// Regresses other rows in the way in which `model` was, without any search: the same form, hyper-parameters,
// layers. Curves are not checked for soundness.
remap::MappingKind regress_again(const Regression& model, const std::vector<TableRow>& rows,
                                 const RegressionOptions& options);

// The box that rows cover. Specular starts at 0.
remap::Domain covered_domain(const std::vector<TableRow>& rows);

}  // namespace remapc
