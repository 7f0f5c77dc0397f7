#include "fit/regressors.hpp"

#include <algorithm>
#include <stdexcept>

#include "fit/parametric/parametric.hpp"
#include "fit/parametric/specular_terms.hpp"
#include "fit/series/series.hpp"

namespace remapc {
namespace {

// The options of one regression with the seed and the threads of all.
template <typename Options>
Options joined(Options own, const RegressionOptions& all) {
  own.seed = all.seed;
  own.jobs = all.jobs;
  return own;
}

struct RegressAgain {
  const Regression& model;
  const std::vector<TableRow>& rows;
  const RegressionOptions& options;

  remap::MappingKind operator()(const remap::Parametric& near) const {
    const ParametricForm form = find_form(model.method.at("form"));
    return remap::Parametric{fit_roughness(rows, *form.roughness),
                             fit_specular_terms(rows, *form.specular, &near.specular)};
  }
  remap::MappingKind operator()(const remap::Svr&) const {
    return fit_svr(rows, options_from_method(model.method, joined(options.svr, options))).mapping;
  }
  remap::MappingKind operator()(const remap::Mlp&) const {
    return fit_mlp(rows, joined(options.mlp, options)).mapping;
  }
  remap::MappingKind operator()(const remap::Series& near) const { return fit_series_again(near, rows); }
  remap::MappingKind operator()(const remap::Chain&) const {
    throw std::logic_error("chains are composed, not regressed");
  }
};

}  // namespace

Regression regress(Regressor regressor, const std::vector<TableRow>& rows, const remap::Domain& domain,
                   const RegressionOptions& options, const FitProgress& progress) {
  switch (regressor) {
    case Regressor::kParametric:
      return fit_parametric_best(rows, domain, {options.form, options.seed, options.jobs}, progress);
    case Regressor::kSvr:
      return fit_svr(rows, joined(options.svr, options), progress);
    case Regressor::kSeries:
      return fit_series_kind(rows, domain, options.seed);
    case Regressor::kMlp:
      break;
  }
  return fit_mlp(rows, joined(options.mlp, options), progress);
}

remap::MappingKind regress_again(const Regression& model, const std::vector<TableRow>& rows,
                                 const RegressionOptions& options) {
  return std::visit(RegressAgain{model, rows, options}, model.mapping);
}

remap::Domain covered_domain(const std::vector<TableRow>& rows) {
  remap::Domain domain{{1e300, -1e300}, {0.0, 0.0}};
  for (const TableRow& row : rows) {
    domain.alpha.min = std::min(domain.alpha.min, row.alpha1);
    domain.alpha.max = std::max(domain.alpha.max, row.alpha1);
    domain.specular.max = std::max(domain.specular.max, row.specular1);
  }
  return domain;
}

}  // namespace remapc
