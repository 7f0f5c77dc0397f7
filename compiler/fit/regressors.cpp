#include "fit/regressors.hpp"

#include <algorithm>
#include <stdexcept>

#include "fit/parametric/parametric.hpp"
#include "fit/parametric/parametric_parts.hpp"
#include "fit/parametric/specular_terms.hpp"

namespace remapc {
namespace {

SvrOptions svr_options(const RegressionOptions& options) {
  SvrOptions svr = options.svr;
  svr.seed = options.seed;
  svr.jobs = options.jobs;
  return svr;
}

MlpOptions mlp_options(const RegressionOptions& options) {
  MlpOptions mlp = options.mlp;
  mlp.seed = options.seed;
  mlp.jobs = options.jobs;
  return mlp;
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
    return fit_svr(rows, options_from_method(model.method, svr_options(options))).mapping;
  }
  remap::MappingKind operator()(const remap::Mlp&) const {
    return fit_mlp(rows, mlp_options(options)).mapping;
  }
  remap::MappingKind operator()(const remap::Chain&) const {
    throw std::logic_error("chains are composed, not regressed");
  }
};

}  // namespace

Regression regress(Regressor regressor, const std::vector<TableRow>& rows, const remap::Domain& domain,
                   const RegressionOptions& options, const FitProgress& progress) {
  switch (regressor) {
    case Regressor::kParametric: {
      ParametricOptions parametric;
      parametric.form = options.form;
      parametric.seed = options.seed;
      parametric.jobs = options.jobs;
      return fit_parametric_best(rows, domain, parametric, progress);
    }
    case Regressor::kSvr:
      return fit_svr(rows, svr_options(options), progress);
    case Regressor::kMlp:
      break;
  }
  return fit_mlp(rows, mlp_options(options), progress);
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
