#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/errors.hpp"
#include "core/number_text.hpp"
// This file compares fits of one table. It chooses the fit with the fewest numbers among those that look like
// the best.
#include "fit/fit_table.hpp"
#include "lower/form_fit.hpp"
#include "lower/interpreter.hpp"

namespace remap {
namespace {

constexpr int kIterations = 12;
// This limits the terms of a factor. With more terms, a form would overfit the lights that choose it.
constexpr std::size_t kMostComparedTerms = 5;
constexpr FormShape kUnitShape{2, 3};  // follows rows so closely that pictures show no difference
constexpr double kNear = 1.01;         // an error up to this ratio to the best error is close enough
constexpr double kNearRmse = 0.05;     // or up to this difference, in percent of the display's range
constexpr double kNearRow = 0.01;      // or, for rows, up to this difference of relative errors
// Copied numbers are close enough up to this relative difference, the smallest that people see (Weber's
// fraction).
constexpr double kNearCopy = 0.02;
// These are the weights of rows in the refinement, for squared relative errors. Pictures show the errors of
// most rows, so rows only have to prevent a drift, and their weight is low. Pictures do not show highlights
// narrower than a pixel, so such rows have a high weight.
constexpr double kNarrowWidth = 0.05;
constexpr double kNarrowWeight = 3.0, kShownWeight = 0.3;
constexpr std::size_t kMostRows = 60;  // largest number of narrow rows, and of other rows

FormSample sample_of(const TableRow& row) {
  const bool is_corner = row.status == RowStatus::kCorner;
  return {{row.alpha1, row.specular1},
          {row.alpha2, row.specular2},
          is_corner || row.status == RowStatus::kWide,
          is_corner || row.status == RowStatus::kBright};
}

std::vector<FormSample> samples_of(const std::vector<TableRow>& rows) {
  std::vector<FormSample> samples;
  for (const TableRow& row : rows) samples.push_back(sample_of(row));
  return samples;
}

// Returns some of the rows below the limits, with weights proportional to the number of pictures
// (`pictures`).
std::vector<FormSample> weighted_samples(const std::vector<FormSample>& samples, std::size_t pictures) {
  std::vector<FormSample> all;
  for (const bool is_narrow : {true, false}) {
    std::vector<FormSample> kept;
    for (const FormSample& sample : samples)
      if ((sample.source.alpha < kNarrowWidth) == is_narrow && !sample.alpha_at_limit &&
          !sample.specular_at_limit)
        kept.push_back(sample);
    const std::size_t step = kept.size() / kMostRows + 1, count = (kept.size() + step - 1) / step;
    const double weight = (is_narrow ? kNarrowWeight : kShownWeight) * static_cast<double>(pictures) /
                          static_cast<double>(std::max<std::size_t>(count, 1));
    for (std::size_t i = 0; i < kept.size(); i += step) {
      all.push_back(kept[i]);
      all.back().weight = weight;
    }
  }
  return all;
}

// Refines each of `starts` by pictures and rows, and returns the best result. `unit` has the errors of rows
// by which errors are divided.
CompactForm refined(const std::vector<CompactForm>& starts, const Domain& domain,
                    const PairPictures& pictures, const PictureErrors& unit,
                    const std::vector<FormSample>& samples) {
  std::vector<MappedTexel> sources = pictures.sources();
  const std::size_t shown = sources.size();
  const std::vector<FormSample> rows = weighted_samples(samples, shown);
  for (const FormSample& row : rows) sources.push_back(row.source);
  const TexelErrors by_pictures = pictures.choosing_errors(unit);
  const TexelErrors errors = [&](const std::vector<MappedTexel>& targets) {
    std::vector<TexelError> all =
        by_pictures({targets.begin(), targets.begin() + static_cast<std::ptrdiff_t>(shown)});
    for (std::size_t r = 0; r < rows.size(); ++r)
      all.push_back(row_error(targets[shown + r], rows[r].target, rows[r].weight));
    return all;
  };
  return refined_form(starts, domain, sources, errors, kIterations);
}

// Rounds to five digits, so that people can read the headers. Pictures show much less.
CompactForm rounded_form(CompactForm form) {
  const auto round = [](float& number) {
    number = static_cast<float>(rounded(static_cast<double>(number), 5));
  };
  round(form.pole);
  for (FactorTerms* factor : {&form.alpha, &form.specular})
    for (std::vector<float>& row : *factor) std::ranges::for_each(row, round);
  for (float* number : {&form.hinge.turn, &form.hinge.turn_by_alpha, &form.hinge.bend, &form.hinge.spread})
    round(*number);
  return form;
}

double relative_rms(const std::vector<double>& errors, const std::vector<double>& values) {
  double sum = 0.0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double relative = errors[i] * error_weight(values[i]);
    sum += relative * relative;
  }
  return errors.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(errors.size()));
}

// Returns the held-out rows, or the training rows if none were held out.
const std::vector<TableRow>& judging_rows(const RowSplit& split) {
  return split.held_out.empty() ? split.training : split.held_out;
}

CandidateRecord record_of(const std::string& name, const RowSplit& split, const Fit& fit) {
  CandidateRecord record;
  record.name = name;
  record.number_count = number_count(fit.mapping);
  const std::vector<TableRow>& rows = judging_rows(split);
  const Residuals residuals = residuals_of(rows, fit);
  std::vector<double> alphas, speculars;
  for (const TableRow& row : rows) {
    alphas.push_back(row.alpha2);
    speculars.push_back(row.specular2);
  }
  record.alpha = error_figures(residuals.alpha);
  record.specular = error_figures(residuals.specular);
  record.relative_alpha = relative_rms(residuals.alpha, alphas);
  record.relative_specular = relative_rms(residuals.specular, speculars);
  record.pictures = fit.pictures;
  return record;
}

// Before the choice, only candidates that failed have a verdict.
bool may_be_chosen(const CandidateRecord& candidate) { return candidate.verdict.empty(); }

// Runs `work`. If it throws, returns `what: why`, otherwise an empty text. Interruptions are not caught.
template <typename Work>
std::string failure_of(const std::string& what, const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInterrupted) throw;
    return what + ": " + error.what();
  }
  return "";
}

// Writes the verdicts and returns the index of the chosen candidate.
std::size_t choose(std::vector<CandidateRecord>& candidates) {
  PictureErrors best{INFINITY, INFINITY};
  double alpha = INFINITY, specular = INFINITY;
  for (const CandidateRecord& record : candidates) {
    if (!may_be_chosen(record)) continue;
    if (record.pictures)
      best = {std::min(best.rmse, record.pictures->rmse), std::min(best.relative, record.pictures->relative)};
    alpha = std::min(alpha, record.relative_alpha);
    specular = std::min(specular, record.relative_specular);
  }
  // Returns how far a candidate is from the best, in units of what pictures show. A candidate is close enough
  // if the result is at most 1.
  const auto distance = [&](const CandidateRecord& record) {
    if (record.pictures)
      return std::max(record.pictures->rmse / std::max(kNear * best.rmse, best.rmse + kNearRmse),
                      record.pictures->relative / (kNear * best.relative));
    const double least = record.number_count == 0 ? kNearCopy : kNearRow;
    return std::max(record.relative_alpha / std::max(kNear * alpha, least),
                    record.relative_specular / std::max(kNear * specular, least));
  };
  std::size_t chosen = candidates.size();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!may_be_chosen(candidates[i])) continue;
    if (chosen == candidates.size()) {
      chosen = i;
      continue;
    }
    const double here = distance(candidates[i]), there = distance(candidates[chosen]);
    const bool is_near = here <= 1.0, was_near = there <= 1.0;
    if (is_near != was_near ? is_near
        : is_near           ? candidates[i].number_count < candidates[chosen].number_count
                            : here < there)
      chosen = i;
  }
  if (chosen == candidates.size()) {
    std::string reasons;
    for (const CandidateRecord& candidate : candidates)
      reasons += "; " + candidate.name + ": " + candidate.verdict;
    throw numeric_error("fit: no form fits the table" + reasons);
  }
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (may_be_chosen(candidates[i]))
      candidates[i].verdict = i == chosen                      ? "chosen"
                              : distance(candidates[i]) <= 1.0 ? "more numbers for no other picture"
                                                               : "farther from the best";
  return chosen;
}

}  // namespace

void judge_fit(const RowSplit& split, const PairPictures* pictures, Fit* fit) {
  Residuals residuals = residuals_of(judging_rows(split), *fit);
  fit->alpha_error = error_figures(std::move(residuals.alpha));
  fit->specular_error = error_figures(std::move(residuals.specular));
  if (pictures == nullptr) return;
  const TexelMap map = [fit](double alpha, double specular) { return evaluate_fit(*fit, alpha, specular); };
  const TexelMap copied = [](double alpha, double specular) { return MappedTexel{alpha, specular}; };
  fit->pictures = pictures->judged(map);
  fit->copied_pictures = pictures->judged(copied);
}

Fit compare_forms(const Fit& base, const RowSplit& split, const PairPictures* pictures,
                  const FitProgress& progress, std::vector<Fit>* compared) {
  const std::vector<FormSample> samples = samples_of(split.training);
  const std::vector<FormShape> shapes = form_shapes();
  std::vector<CandidateRecord> candidates;  // in the order in which they are printed
  std::vector<Fit> fits;                    // of each candidate, without a mapping if it failed
  PictureErrors unit;
  if (pictures != nullptr) {
    const CompactForm by_rows = fit_form(samples, base.limits, base.domain, kUnitShape);
    unit = pictures->chosen(
        [&](double alpha, double specular) { return form_texel(by_rows, base.domain, alpha, specular); });
  }
  const auto enter = [&](const std::string& name, const auto& mapping_of) {
    CandidateRecord& candidate = candidates.emplace_back();
    Fit& fit = fits.emplace_back();
    candidate.name = name;
    candidate.verdict = failure_of("not fitted", [&] {
      fit = base;
      fit.mapping = mapping_of();
      judge_fit(split, pictures, &fit);
      candidate = record_of(name, split, fit);
    });
    if (progress) progress(static_cast<double>(candidates.size()) / static_cast<double>(shapes.size() + 1));
  };
  std::vector<CompactForm> sound, by_pictures;
  enter("copied", [] { return CompactForm{}; });
  for (const FormShape& shape : shapes) {
    if (pictures != nullptr && term_count(shape) > kMostComparedTerms) continue;
    enter(shape_name(shape), [&] {
      CompactForm form = fit_form(samples, base.limits, base.domain, shape, sound);
      if (!is_sound(form, base.domain))
        throw numeric_error("is not positive, or falls while the source rises");
      sound.push_back(form);
      if (pictures != nullptr) {
        std::vector<CompactForm> starts = {form};
        const auto smaller =
            std::find_if(by_pictures.rbegin(), by_pictures.rend(),
                         [&](const CompactForm& refined_before) { return is_within(refined_before, shape); });
        if (smaller != by_pictures.rend()) starts.push_back(padded(*smaller, shape));
        form = refined(starts, base.domain, *pictures, unit, samples);
        by_pictures.push_back(form);
      }
      return within_limits(rounded_form(form), base.domain, base.limits);
    });
  }
  Fit& chosen = fits[choose(candidates)];
  chosen.method["chosen by"] =
      pictures != nullptr ? "pictures of other materials under other lights" : "rows held out";
  Fit fitted = chosen;
  fitted.candidates = candidates;
  if (compared != nullptr)
    std::ranges::copy_if(fits, std::back_inserter(*compared),
                         [&](const Fit& fit) { return fit.id == base.id; });
  return fitted;
}

}  // namespace remap
