#include "lower/form_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>

#include "core/errors.hpp"
#include "lower/interpreter.hpp"

namespace remap {
namespace {

constexpr std::array kPoles = {0.02, 0.035, 0.06, 0.1, 0.17, 0.3, 0.5, 1.0};
constexpr float kMostBend = 4.0f;  // with a larger bend, a hinge is a step
constexpr double kLeastShown = 0.02, kLeastRelative = 2e-4;
constexpr int kRowIterations = 30;
constexpr int kGrid = 80;               // steps over the domain, in each direction
constexpr double kLeastFactor = 1e-5;   // factors of a sound form are at least this large
constexpr double kSmallestGain = 2e-5;  // smallest relative gain in the sum of errors that continues a search
constexpr double kStep = 1e-5;          // smallest change of a number for difference quotients
constexpr double kRidge = 1e-9;         // relative ridge of normal equations

std::vector<std::pair<int, int>> products(const FormShape& shape) {
  std::vector<std::pair<int, int>> all;
  for (std::size_t j = 0; j < shape.powers; ++j)
    for (std::size_t i = 0; i + j < shape.terms; ++i)
      all.emplace_back(static_cast<int>(j), static_cast<int>(i));
  return all;
}

FactorTerms shaped(const FormShape& shape, const Eigen::VectorXd& numbers) {
  FactorTerms factor(shape.powers);
  Eigen::Index next = 0;
  for (const auto& [j, i] : products(shape))
    factor[static_cast<std::size_t>(j)].push_back(static_cast<float>(numbers[next++]));
  return factor;
}

// Fits a factor, so that each source times the factor is close to its target. Uses only the samples for which
// `counts` returns true.
template <typename Counts, typename Source, typename Target>
std::pair<FactorTerms, double> fit_factor(const std::vector<FormSample>& samples, const FormShape& shape,
                                          double pole, double least_shown, const Counts& counts,
                                          const Source& source, const Target& target) {
  const auto terms = products(shape);
  std::vector<const FormSample*> kept;
  for (const FormSample& sample : samples)
    if (counts(sample)) kept.push_back(&sample);
  if (kept.size() < terms.size())
    throw numeric_error("form: " + std::to_string(kept.size()) + " rows below the limits do not determine " +
                        std::to_string(terms.size()) + " numbers");
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(kept.size()), static_cast<Eigen::Index>(terms.size()));
  Eigen::VectorXd wanted(matrix.rows());
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    const FormSample& sample = *kept[static_cast<std::size_t>(r)];
    const double weight = error_weight(target(sample), least_shown),
                 t = sample.source.specular / (sample.source.specular + pole);
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) {
      const auto& [j, i] = terms[static_cast<std::size_t>(k)];
      matrix(r, k) = weight * source(sample) * std::pow(t, j) * std::pow(sample.source.alpha, i);
    }
    wanted[r] = weight * target(sample);
  }
  const Eigen::VectorXd numbers = matrix.colPivHouseholderQr().solve(wanted);
  return {shaped(shape, numbers), (matrix * numbers - wanted).squaredNorm()};
}

// Returns the form with the least squares on the samples below the limits. It has no hinge yet.
CompactForm least_squares(const std::vector<FormSample>& samples, const Limits& limits,
                          const FormShape& shape, double least_shown = kLeastShown) {
  CompactForm best;
  double least = INFINITY;
  const auto is_free = [](const FormSample& sample) {
    return !sample.alpha_at_limit && !sample.specular_at_limit;
  };
  const auto alpha = [](const FormSample& sample) { return sample.source.alpha; };
  const auto specular = [](const FormSample& sample) { return sample.source.specular; };
  const auto has_light = [&](const FormSample& sample) {
    return is_free(sample) && sample.source.specular > 0.0;
  };
  for (const double pole : kPoles) {
    if (shape.powers == 1 && pole != kPoles.back()) continue;
    CompactForm form;
    form.pole = static_cast<float>(pole);
    double alpha_error = 0.0, specular_error = 0.0;
    std::tie(form.alpha, alpha_error) = fit_factor(samples, shape, pole, least_shown, is_free, alpha,
                                                   [](const FormSample& s) { return s.target.alpha; });
    std::tie(form.specular, specular_error) =
        fit_factor(samples, shape, pole, least_shown, has_light, specular,
                   [](const FormSample& s) { return s.target.specular; });
    if (alpha_error + specular_error >= least) continue;
    least = alpha_error + specular_error;
    best = form;
  }
  if (std::ranges::any_of(samples, &FormSample::alpha_at_limit))
    best.alpha_limit = static_cast<float>(limits.alpha);
  if (limits.specular && std::ranges::any_of(samples, &FormSample::specular_at_limit))
    best.specular_limit = static_cast<float>(*limits.specular);
  return best;
}

std::vector<MappedTexel> targets_of(const CompactForm& form, const Domain& domain,
                                    const std::vector<MappedTexel>& sources) {
  std::vector<MappedTexel> targets;
  targets.reserve(sources.size());
  for (const MappedTexel& source : sources)
    targets.push_back(form_texel(form, domain, source.alpha, source.specular));
  return targets;
}

// Returns a texel of the grid over the domain, which is denser where alpha is small.
MappedTexel grid_texel(const Domain& domain, int i, int j) {
  const auto between = [](const Range& range, double share) {
    return range.min + (range.max - range.min) * share;
  };
  const double share = static_cast<double>(i) / kGrid;
  return {between(domain.alpha, share * share), between(domain.specular, static_cast<double>(j) / kGrid)};
}

double sum_of(const std::vector<TexelError>& errors) {
  double sum = 0.0;
  for (const TexelError& error : errors) sum += error.value;
  return sum;
}

// Returns, for each source, the derivatives of target alpha and target specular with respect to the numbers
// of the form.
std::vector<Eigen::MatrixXd> slopes_of(const CompactForm& form, const Domain& domain,
                                       const std::vector<MappedTexel>& sources,
                                       const std::vector<MappedTexel>& targets) {
  const std::vector<double> numbers = numbers_of(form);
  const auto count = static_cast<Eigen::Index>(numbers.size());
  std::vector<Eigen::MatrixXd> slopes(sources.size(), Eigen::MatrixXd(2, count));
  for (Eigen::Index k = 0; k < count; ++k) {
    std::vector<double> moved = numbers;
    // Forms hold floats, so a step must be large enough to change a float.
    const double step = std::max(kStep, std::fabs(numbers[static_cast<std::size_t>(k)]) * 1e-3);
    moved[static_cast<std::size_t>(k)] += step;
    const std::vector<MappedTexel> beyond = targets_of(with_numbers(form, moved), domain, sources);
    for (std::size_t r = 0; r < sources.size(); ++r) {
      slopes[r](0, k) = (beyond[r].alpha - targets[r].alpha) / step;
      slopes[r](1, k) = (beyond[r].specular - targets[r].specular) / step;
    }
  }
  return slopes;
}

// Return the derivatives of the sum of errors with respect to the numbers of the form.
Eigen::MatrixXd curvature_of(const std::vector<Eigen::MatrixXd>& slopes,
                             const std::vector<TexelError>& errors) {
  const Eigen::Index count = slopes.front().cols();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(count, count);
  for (std::size_t r = 0; r < slopes.size(); ++r) {
    Eigen::Matrix2d curvature;
    curvature << errors[r].by_alpha_2, errors[r].by_both, errors[r].by_both, errors[r].by_specular_2;
    sum += slopes[r].transpose() * curvature * slopes[r];
  }
  return sum;
}

Eigen::VectorXd gradient_of(const std::vector<Eigen::MatrixXd>& slopes,
                            const std::vector<TexelError>& errors) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(slopes.front().cols());
  for (std::size_t r = 0; r < slopes.size(); ++r)
    sum += slopes[r].transpose() * Eigen::Vector2d(errors[r].by_alpha, errors[r].by_specular);
  return sum;
}

// Returns the best form that a search from `start` finds, and the sum of its errors.
std::pair<CompactForm, double> refined_from(const CompactForm& start, const Domain& domain,
                                            const std::vector<MappedTexel>& sources,
                                            const TexelErrors& errors, int iterations) {
  CompactForm best = start;
  std::vector<MappedTexel> targets = targets_of(best, domain, sources);
  std::vector<TexelError> here = errors(targets);
  double least = sum_of(here), damping = 1e-3;
  for (int i = 0; i < iterations; ++i) {
    const std::vector<Eigen::MatrixXd> slopes = slopes_of(best, domain, sources, targets);
    const Eigen::MatrixXd undamped = curvature_of(slopes, here);
    const Eigen::VectorXd gradient = gradient_of(slopes, here);
    const std::vector<double> numbers = numbers_of(best);
    bool is_better = false;
    for (int attempt = 0; attempt < 6 && !is_better; ++attempt, damping *= 6.0) {
      Eigen::MatrixXd curvature = undamped;
      const double ridge = kRidge * curvature.trace();
      for (Eigen::Index k = 0; k < curvature.rows(); ++k)
        curvature(k, k) += damping * curvature(k, k) + ridge;
      const Eigen::VectorXd step = curvature.ldlt().solve(gradient);
      std::vector<double> moved = numbers;
      for (std::size_t k = 0; k < moved.size(); ++k) moved[k] -= step[static_cast<Eigen::Index>(k)];
      const CompactForm tried = with_numbers(best, moved);
      if (!step.allFinite() || !is_sound(tried, domain)) continue;
      const std::vector<MappedTexel> there = targets_of(tried, domain, sources);
      const std::vector<TexelError> found = errors(there);
      const double sum = sum_of(found);
      if (!(sum < least)) continue;
      is_better = true;
      best = tried;
      targets = there;
      here = found;
      const bool is_done = sum > least * (1.0 - kSmallestGain);
      least = sum;
      if (is_done) return {best, least};
    }
    if (!is_better) return {best, least};
    damping *= 1.0 / 60.0;
  }
  return {best, least};
}

std::vector<TexelError> row_errors(const std::vector<FormSample>& samples,
                                   const std::vector<MappedTexel>& targets) {
  std::vector<TexelError> errors(targets.size());
  for (std::size_t r = 0; r < targets.size(); ++r) errors[r] = row_error(targets[r], samples[r].target, 1.0);
  return errors;
}

std::vector<MappedTexel> sources_of(const std::vector<FormSample>& samples) {
  std::vector<MappedTexel> sources;
  for (const FormSample& sample : samples) sources.push_back(sample.source);
  return sources;
}

CompactForm refined_by_rows(const std::vector<CompactForm>& starts, const Domain& domain,
                            const std::vector<FormSample>& samples) {
  const auto errors = [&](const std::vector<MappedTexel>& targets) { return row_errors(samples, targets); };
  return refined_form(starts, domain, sources_of(samples), errors, kRowIterations);
}

// Returns the best form whose terms lie within the shape, or null if there is none.
const CompactForm* best_within(const std::vector<CompactForm>& forms, const FormShape& shape,
                               const Domain& domain, const std::vector<FormSample>& samples) {
  const std::vector<MappedTexel> sources = sources_of(samples);
  const CompactForm* best = nullptr;
  double least = INFINITY;
  for (const CompactForm& form : forms) {
    if (!is_within(form, shape)) continue;
    const double error = sum_of(row_errors(samples, targets_of(form, domain, sources)));
    if (error < least) {
      least = error;
      best = &form;
    }
  }
  return best;
}

}  // namespace

double error_weight(double value, double least) { return 1.0 / std::max(value, least); }

std::vector<FormShape> form_shapes() {
  return {{1, 1}, {1, 2}, {2, 2}, {1, 4}, {2, 3}, {1, 6}, {3, 4}, {2, 5}};
}

bool is_within(const CompactForm& form, const FormShape& shape) {
  const auto fits = [&](const FactorTerms& factor) {
    if (factor.size() > shape.powers) return false;
    for (std::size_t j = 0; j < factor.size(); ++j)
      if (factor[j].size() + j > shape.terms) return false;
    return true;
  };
  return fits(form.alpha) && fits(form.specular);
}

CompactForm padded(CompactForm form, const FormShape& shape) {
  for (FactorTerms* factor : {&form.alpha, &form.specular}) {
    factor->resize(std::max(factor->size(), shape.powers));
    for (std::size_t j = 0; j < factor->size(); ++j)
      (*factor)[j].resize(std::max((*factor)[j].size(), shape.terms - j), 0.0f);
  }
  return form;
}

TexelError row_error(const MappedTexel& found, const MappedTexel& wanted, double weight) {
  const double a = error_weight(wanted.alpha), s = error_weight(wanted.specular);
  const double off_alpha = a * (found.alpha - wanted.alpha),
               off_specular = s * (found.specular - wanted.specular);
  return {weight * (off_alpha * off_alpha + off_specular * off_specular),
          2.0 * weight * a * off_alpha,
          2.0 * weight * s * off_specular,
          2.0 * weight * a * a,
          0.0,
          2.0 * weight * s * s};
}

std::size_t term_count(const FormShape& shape) { return products(shape).size(); }

std::string shape_name(const FormShape& shape) {
  return std::to_string(shape.powers) + " x " + std::to_string(shape.terms);
}

std::vector<double> numbers_of(const CompactForm& form) {
  std::vector<double> numbers = {std::log(static_cast<double>(form.pole))};
  for (const FactorTerms* factor : {&form.alpha, &form.specular})
    for (const std::vector<float>& row : *factor) numbers.insert(numbers.end(), row.begin(), row.end());
  if (form.alpha_limit || form.specular_limit)
    for (const float number : {form.hinge.turn, form.hinge.turn_by_alpha, form.hinge.bend, form.hinge.spread})
      numbers.push_back(static_cast<double>(number));
  return numbers;
}

CompactForm with_numbers(CompactForm form, const std::vector<double>& numbers) {
  auto next = numbers.begin();
  form.pole = static_cast<float>(std::exp(std::clamp(*next++, std::log(0.01), std::log(4.0))));
  for (FactorTerms* factor : {&form.alpha, &form.specular})
    for (std::vector<float>& row : *factor)
      for (float& term : row) term = static_cast<float>(*next++);
  if (form.alpha_limit || form.specular_limit)
    for (float* number : {&form.hinge.turn, &form.hinge.turn_by_alpha, &form.hinge.bend, &form.hinge.spread})
      *number = static_cast<float>(*next++);
  form.hinge.bend = std::clamp(form.hinge.bend, 0.0f, kMostBend);
  return form;
}

CompactForm fit_form(const std::vector<FormSample>& samples, const Limits& limits, const Domain& domain,
                     const FormShape& shape, const std::vector<CompactForm>& sound) {
  const CompactForm nearest = least_squares(samples, limits, shape);
  const bool is_limited = nearest.alpha_limit || nearest.specular_limit;
  if (!is_limited && is_sound(nearest, domain)) return nearest;
  // In this start, small values have as much weight as large values. It keeps factors positive that begin
  // close to 0.
  std::vector<CompactForm> starts = {nearest, least_squares(samples, limits, shape, kLeastRelative)};
  if (const CompactForm* smaller = best_within(sound, shape, domain, samples))
    starts.push_back(padded(*smaller, shape));
  return refined_by_rows(starts, domain, samples);
}

CompactForm refined_form(const std::vector<CompactForm>& starts, const Domain& domain,
                         const std::vector<MappedTexel>& sources, const TexelErrors& errors, int iterations) {
  CompactForm best;
  double least = INFINITY;
  bool is_best_sound = false;
  for (const CompactForm& start : starts) {
    const auto [form, sum] = refined_from(start, domain, sources, errors, iterations);
    const bool sound = is_sound(form, domain);
    if (sound < is_best_sound || (sound == is_best_sound && !(sum < least))) continue;
    best = form;
    least = sum;
    is_best_sound = sound;
  }
  return best;
}

bool is_sound(const CompactForm& form, const Domain& domain) {
  std::array<MappedTexel, kGrid + 1> sharper{};
  for (int i = 0; i <= kGrid; ++i) {
    MappedTexel darker{};
    for (int j = 0; j <= kGrid; ++j) {
      const MappedTexel source = grid_texel(domain, i, j);
      const double t = source.specular / (source.specular + static_cast<double>(form.pole));
      const double p = factor_value(form.alpha, source.alpha, t),
                   q = factor_value(form.specular, source.alpha, t);
      if (!(p > kLeastFactor && q > kLeastFactor && std::isfinite(p) && std::isfinite(q))) return false;
      const MappedTexel texel = form_texel(form, domain, source.alpha, source.specular);
      if (!(texel.alpha > kLeastFactor * source.alpha)) return false;
      const bool is_free = texel.alpha < static_cast<double>(form.alpha_limit.value_or(INFINITY)) &&
                           texel.specular < static_cast<double>(form.specular_limit.value_or(INFINITY));
      if (is_free && i > 0 && texel.alpha < sharper[static_cast<std::size_t>(j)].alpha) return false;
      if (is_free && j > 0 && texel.specular < darker.specular) return false;
      sharper[static_cast<std::size_t>(j)] = darker = texel;
    }
  }
  return true;
}

CompactForm within_limits(CompactForm form, const Domain& domain, const Limits& limits) {
  for (int i = 0; i <= kGrid; ++i)
    for (int j = 0; j <= kGrid; ++j) {
      const MappedTexel source = grid_texel(domain, i, j);
      const MappedTexel texel = form_texel(form, domain, source.alpha, source.specular);
      if (texel.alpha > limits.alpha) form.alpha_limit = static_cast<float>(limits.alpha);
      if (limits.specular && texel.specular > *limits.specular)
        form.specular_limit = static_cast<float>(*limits.specular);
    }
  return form;
}

}  // namespace remap
