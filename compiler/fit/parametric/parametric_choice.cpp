// Chooses the form of the parametric kind for a set of rows.
#include <atomic>

#include "core/number_text.hpp"
#include "core/parallel.hpp"
#include "fit/parametric/parametric.hpp"
#include "fit/parametric/specular_terms.hpp"
#include "table/choice.hpp"

namespace remap {
namespace {

// Rows used for the choice. More rows take longer and do not change the result.
constexpr std::size_t kMostRows = 4000;

constexpr std::size_t kFolds = 10;

// Fits target alpha alone.
Regression fit_form(const std::vector<TableRow>& rows, const Domain& domain, const RoughnessForm& form) {
  const auto fit = [&form](const std::vector<TableRow>& some) {
    return Parametric{fit_roughness(some, form), {}};
  };
  const Parametric whole = fit(rows);
  require_rising_alpha(whole, domain);
  return {whole, {}, fit};
}

// Fits target specular alone.
Regression fit_form(const std::vector<TableRow>& rows, const Domain& domain, const SpecularForm& form) {
  const Parametric whole{{}, fit_specular_terms(rows, form)};
  require_rising_specular(whole, domain, least_positive_specular(rows));
  return {whole, {}, [&form, near = whole.specular](const std::vector<TableRow>& some) {
            return Parametric{{}, fit_specular_terms(some, form, &near)};
          }};
}

template <typename Form>
struct FormChoice {
  const Form* form;    // the first if none can be fitted
  std::string errors;  // of each form
};

// `error`: of the output that the forms fit; they leave the other one at 0, so that its error tells nothing.
template <typename Form>
FormChoice<Form> choose_form(std::span<const Form> forms, RelativeError CandidateRecord::*error,
                             const std::vector<TableRow>& rows, const Domain& domain,
                             const ParametricOptions& options, const FitProgress& progress) {
  std::vector<Candidate> candidates(forms.size());
  std::atomic<std::size_t> done{0};
  run_parallel(forms.size(), options.jobs, [&](std::size_t i) {
    // The slowest forms start first, so that the threads end at about the same time.
    const std::size_t f = forms.size() - 1 - i;
    CandidateRecord& record = candidates[f].record;
    record.name = forms[f].name;
    record.number_count = forms[f].coefficient_count();
    record.verdict =
        failure_of("not fitted", [&] { candidates[f].regression = fit_form(rows, domain, forms[f]); });
    if (progress) progress(0.5 * static_cast<double>(++done) / static_cast<double>(forms.size()));
  });
  cross_validate(
      candidates, split_folds(rows, kFolds, options.seed), [](double) { return 1.0; }, options.jobs,
      part_of(progress, 0.5, 1.0));
  std::string errors;
  for (const auto& [record, regression] : candidates)
    errors += (errors.empty() ? "" : ", ") + record.name + " " +
              (record.verdict.empty() ? number_text(rounded_up((record.*error).rms, 2)) : "-");
  const std::size_t chosen = choose(&candidates);
  return {&forms[chosen == forms.size() ? 0 : chosen], errors};
}

}  // namespace

Regression fit_parametric_best(const std::vector<TableRow>& rows, const Domain& domain,
                               const ParametricOptions& options, const FitProgress& progress) {
  ParametricForm form;
  std::map<std::string, std::string> method;
  if (!options.form.empty()) {
    form = find_form(options.form);
    method["form chosen by"] = "the caller";
  } else {
    const std::vector<TableRow> drawn = draw_rows(rows, kMostRows, options.seed);
    const auto roughness = choose_form(roughness_forms(), &CandidateRecord::relative_alpha, drawn, domain,
                                       options, part_of(progress, 0.0, 0.1));
    const auto specular = choose_form(specular_forms(), &CandidateRecord::relative_specular, drawn, domain,
                                      options, part_of(progress, 0.1, 1.0));
    form = {roughness.form, specular.form};
    method = {{"form chosen by", std::to_string(kFolds) + "-fold cross-validation on " +
                                     std::to_string(drawn.size()) + " training rows, seed " +
                                     std::to_string(options.seed) + "; simplest within one standard error"},
              {"alpha rms by form", roughness.errors},
              {"specular rms by form", specular.errors}};
  }
  method["form"] = form_name(form);
  const Parametric whole = fit_parametric(rows, domain, form);
  return {whole, method, [form, near = whole.specular](const std::vector<TableRow>& some) {
            return Parametric{fit_roughness(some, *form.roughness),
                              fit_specular_terms(some, *form.specular, &near)};
          }};
}

}  // namespace remap
