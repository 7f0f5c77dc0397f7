// Chooses the form of the parametric kind for a set of rows.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "fit/parametric/parametric.hpp"
#include "fit/parametric/parametric_parts.hpp"
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

// The cross-validation results of the forms of one output, in their order; empty for a form that the rows do
// not determine.
using Scores = std::vector<std::optional<CrossValidated>>;

struct Task {
  const std::vector<TableRow>& rows;
  const remap::Domain& domain;
  std::vector<Fold> folds;
};

CrossValidated score(const Task& task, const RoughnessForm& form) {
  require_rising_alpha({fit_roughness(task.rows, form), {}}, task.domain);
  std::vector<std::vector<double>> errors(task.folds.size());
  for (std::size_t f = 0; f < task.folds.size(); ++f) {
    if (task.folds[f].judging.empty()) continue;
    const Parametric part{fit_roughness(task.folds[f].training, form), {}};
    for (const TableRow& row : task.folds[f].judging)
      errors[f].push_back(remap::target_alpha(part, row.alpha1, row.specular1) - row.alpha2);
  }
  return cross_validated(errors);
}

CrossValidated score(const Task& task, const SpecularForm& form) {
  const Parametric whole{{}, fit_specular_terms(task.rows, form)};
  require_rising_specular(whole, task.domain, least_positive_specular(task.rows));
  std::vector<std::vector<double>> errors(task.folds.size());
  for (std::size_t f = 0; f < task.folds.size(); ++f) {
    if (task.folds[f].judging.empty()) continue;
    const Parametric part{{}, fit_specular_terms(task.folds[f].training, form, &whole.specular)};
    for (const TableRow& row : task.folds[f].judging)
      errors[f].push_back(remap::target_specular(part, row.alpha1, row.specular1) - row.specular2);
  }
  return cross_validated(errors);
}

template <typename Form>
std::optional<CrossValidated> score_or_none(const Task& task, const Form& form) {
  try {
    return score(task, form);
  } catch (const remap::Error& error) {
    if (error.kind() == remap::ErrorKind::kInterrupted) throw;
    return std::nullopt;
  }
}

// The simplest form within one standard error of the best; the first if no form has a score.
template <typename Form>
const Form* choose(std::span<const Form> forms, const Scores& scores) {
  double best = 1e300, bound = 1e300;
  for (const auto& score : scores) {
    if (!score || !(score->rms < best)) continue;
    best = score->rms;
    bound = best + std::max(score->standard_error, kNegligibleError);
  }
  const Form* chosen = nullptr;
  for (std::size_t i = 0; i < forms.size(); ++i)
    if (scores[i] && scores[i]->rms <= bound &&
        (chosen == nullptr || forms[i].coefficient_count() < chosen->coefficient_count()))
      chosen = &forms[i];
  return chosen == nullptr ? &forms.front() : chosen;
}

template <typename Form>
std::string score_text(std::span<const Form> forms, const Scores& scores) {
  std::string text;
  for (std::size_t i = 0; i < forms.size(); ++i)
    text += (i == 0 ? "" : ", ") + std::string(forms[i].name) + " " +
            (scores[i] ? remap::number_text(remap::rounded_up(scores[i]->rms, 2)) : "-");
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
  Task task{drawn, domain, {}};
  const auto fold_of_row = draw_folds(drawn, options.folds, options.seed);
  for (std::size_t f = 0; f < options.folds; ++f) task.folds.push_back(select_fold(drawn, fold_of_row, f));

  const auto roughness = roughness_forms();
  const auto specular = specular_forms();
  Scores alpha_scores(roughness.size()), specular_scores(specular.size());
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
           {"form chosen by", std::to_string(options.folds) + "-fold cross-validation on " +
                                  std::to_string(drawn.size()) + " training rows, seed " +
                                  std::to_string(options.seed) + "; simplest within one standard error"},
           {"alpha rms by form", score_text(roughness, alpha_scores)},
           {"specular rms by form", score_text(specular, specular_scores)}}};
}

}  // namespace remapc
