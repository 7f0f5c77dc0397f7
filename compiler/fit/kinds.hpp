// This file lists the kinds of fits. Each kind has a folder with its regression, and one line in the list.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "fit/network/mlp.hpp"
#include "table/regression.hpp"

namespace remap {

struct FitOptions {
  std::string id;          // if empty, `<source>_to_<target>` from the table
  std::string_view kind;   // one of kFitKinds; if empty, compare_forms() chooses
  std::uint64_t seed = 1;  // seed of the split and of the regression
  unsigned jobs = 0;       // threads; 0: one per core. Results do not depend on it
  std::string form;        // form of the parametric kind; if empty, the paper's
  MlpOptions mlp;          // its seed and jobs are replaced by those above
  double held_out_fraction = 0.2;
  bool accept_light = false;  // see is_wrong_light() (table/light.hpp)
};

// A FitKind is a regression that a user can choose. It fits the rows below the limits of the target. If the
// user chooses none, forms are compared (comparison.hpp).
struct FitKind {
  std::string_view name;
  // Fits the rows. The curves must be sound in `domain`. Throws the errors of the regression.
  Regression (*fit)(const std::vector<TableRow>& rows, const Domain& domain, const FitOptions& options,
                    const FitProgress& progress);
};

extern const std::array<FitKind, 3> kFitKinds;

// Returns a kind by its name. Throws kUsage for a name that is not in the list.
const FitKind& fit_kind(std::string_view name);

}  // namespace remap
