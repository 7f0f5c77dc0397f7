// Chooses the form of the parametric kind for a set of rows.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "fit/parametric/parametric.hpp"
#include "fit/parametric/specular_terms.hpp"
#include "fit/rows/folds.hpp"
#include "model/evaluate.hpp"
#include "remap/error.hpp"
#include "system/parallel.hpp"
#include "text/number_text.hpp"

namespace remapc {
namespace {

using remap::Parametric;

// Rows used for the choice. More rows take longer and do not change the result.
constexpr std::size_t kMostRows = 4000;

constexpr std::size_t kFolds = 10;

struct Task {
  const std::vector<TableRow>& rows;
  const remap::Domain& domain;
  std::vector<Fold> folds;
};

// `fit`: fits rows. `value`: the output that it fits.
CrossValidated score_folds(const Task& task, double TableRow::*output,
                           const std::function<Parametric(const std::vector<TableRow>&)>& fit,
                           double (*value)(const Parametric&, const double&, const double&)) {
  std::vector<std::vector<double>> errors;
  for (const Fold& fold : task.folds) {
    errors.emplace_back();
    if (fold.judging.empty()) continue;
    const Parametric part = fit(fold.training);
    for (const TableRow& row : fold.judging)
      errors.back().push_back(value(part, row.alpha1, row.specular1) - row.*output);
  }
  return cross_validated(errors);
}

CrossValidated score(const Task& task, const RoughnessForm& form) {
  const auto fit = [&](const std::vector<TableRow>& rows) {
    return Parametric{fit_roughness(rows, form), {}};
  };
  require_rising_alpha(fit(task.rows), task.domain);
  return score_folds(task, &TableRow::alpha2, fit, remap::target_alpha);
}

CrossValidated score(const Task& task, const SpecularForm& form) {
  const Parametric whole{{}, fit_specular_terms(task.rows, form)};
  require_rising_specular(whole, task.domain, least_positive_specular(task.rows));
  const auto fit = [&](const std::vector<TableRow>& rows) {
    return Parametric{{}, fit_specular_terms(rows, form, &whole.specular)};
  };
  return score_folds(task, &TableRow::specular2, fit, remap::target_specular);
}

// Infinite for a form that the rows do not determine.
template <typename Form>
CrossValidated score_or_none(const Task& task, const Form& form) {
  try {
    return score(task, form);
  } catch (const remap::Error& error) {
    if (error.kind() == remap::ErrorKind::kInterrupted) throw;
    return {std::numeric_limits<double>::infinity(), 0.0};
  }
}

// The simplest form that counts as equal to the best; the first if no form has a score.
template <typename Form>
const Form* choose(std::span<const Form> forms, const std::vector<CrossValidated>& scores) {
  const double bound = error_bound(scores);
  const Form* chosen = nullptr;
  for (std::size_t i = 0; i < forms.size(); ++i)
    if (scores[i].rms <= bound &&
        (chosen == nullptr || forms[i].coefficient_count() < chosen->coefficient_count()))
      chosen = &forms[i];
  return chosen == nullptr ? &forms.front() : chosen;
}

template <typename Form>
std::string score_text(std::span<const Form> forms, const std::vector<CrossValidated>& scores) {
  std::string text;
  for (std::size_t i = 0; i < forms.size(); ++i)
    text += (i == 0 ? "" : ", ") + std::string(forms[i].name) + " " +
            (std::isfinite(scores[i].rms) ? remap::number_text(remap::rounded_up(scores[i].rms, 2)) : "-");
  return text;
}

}  // namespace

Regression fit_parametric_best(const std::vector<TableRow>& rows, const remap::Domain& domain,
                               const ParametricOptions& options, const FitProgress& progress) {
  if (!options.form.empty()) {
    const ParametricForm form = find_form(options.form);
    return {fit_parametric(rows, domain, form),
            {{"form", form_name(form)}, {"form chosen by", "the caller"}}};
  }
  const std::vector<TableRow> drawn = draw_rows(rows, kMostRows, options.seed);
  const Task task{drawn, domain, split_folds(drawn, kFolds, options.seed)};

  const auto roughness = roughness_forms();
  const auto specular = specular_forms();
  std::vector<CrossValidated> alpha_scores(roughness.size()), specular_scores(specular.size());
  const std::size_t count = roughness.size() + specular.size();
  std::atomic<std::size_t> done{0};
  remap::run_parallel(count, options.jobs, [&](std::size_t i) {
    // The slowest forms start first, so that the threads end at about the same time.
    const std::size_t form = count - 1 - i;
    if (form < roughness.size())
      alpha_scores[form] = score_or_none(task, roughness[form]);
    else
      specular_scores[form - roughness.size()] = score_or_none(task, specular[form - roughness.size()]);
    if (progress) progress(static_cast<double>(++done) / static_cast<double>(count));
  });

  const ParametricForm form = {choose(roughness, alpha_scores), choose(specular, specular_scores)};
  return {fit_parametric(rows, domain, form),
          {{"form", form_name(form)},
           {"form chosen by", std::to_string(kFolds) + "-fold cross-validation on " +
                                  std::to_string(drawn.size()) + " training rows, seed " +
                                  std::to_string(options.seed) + "; simplest within one standard error"},
           {"alpha rms by form", score_text(roughness, alpha_scores)},
           {"specular rms by form", score_text(specular, specular_scores)}}};
}

}  // namespace remapc
