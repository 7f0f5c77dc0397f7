#include "fit/kinds.hpp"

#include "core/errors.hpp"
#include "fit/parametric/parametric.hpp"
#include "fit/svr/svr.hpp"

namespace remap {

Regression fit_kind(const std::vector<TableRow>& rows, const Domain& domain, const FitOptions& options,
                    const FitProgress& progress) {
  if (options.kind == "parametric") return fit_parametric_kind(rows, domain, options.form);
  if (options.kind == "svr") return fit_svr(rows, {options.seed, options.jobs, {}, {}}, progress);
  if (options.kind != "mlp") throw usage_error("unknown kind of fit '" + std::string(options.kind) + "'");
  MlpOptions mlp = options.mlp;
  mlp.seed = options.seed;
  mlp.jobs = options.jobs;
  return fit_mlp(rows, mlp, progress);
}

}  // namespace remap
