#include "fit/kinds.hpp"

#include <algorithm>

#include "core/errors.hpp"
#include "fit/parametric/parametric.hpp"
#include "fit/svr/svr.hpp"

namespace remap {
namespace {

using Rows = std::vector<TableRow>;

}  // namespace

constinit const std::array<FitKind, 3> kFitKinds = {{
    {"parametric", [](const Rows& rows, const Domain& domain, const FitOptions& options,
                      const FitProgress&) { return fit_parametric_kind(rows, domain, options.form); }},
    {"svr",
     [](const Rows& rows, const Domain&, const FitOptions& options, const FitProgress& progress) {
       return fit_svr(rows, {options.seed, options.jobs, {}, {}}, progress);
     }},
    {"mlp",
     [](const Rows& rows, const Domain&, const FitOptions& options, const FitProgress& progress) {
       MlpOptions mlp = options.mlp;
       mlp.seed = options.seed;
       mlp.jobs = options.jobs;
       return fit_mlp(rows, mlp, progress);
     }},
}};

const FitKind& fit_kind(std::string_view name) {
  const auto found = std::ranges::find(kFitKinds, name, &FitKind::name);
  if (found == kFitKinds.end()) throw usage_error("unknown kind of fit '" + std::string(name) + "'");
  return *found;
}

}  // namespace remap
