#include "study/reach.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/parallel.hpp"
#include "lower/interpreter.hpp"
#include "measure/objective.hpp"
#include "measure/picture_taker.hpp"
#include "measure/probe.hpp"
#include "measure/specular_response.hpp"
#include "measure/sweep.hpp"
#include "remap/version.hpp"
#include "table/csv.hpp"
#include "table/table.hpp"

namespace remap {
namespace {

constexpr double kAlphaRatio = 1.01;  // ratio of neighbouring widths of the target
constexpr std::size_t kStride = 6;    // step between the widths that are examined first
constexpr double kNarrowest = 0.25;   // smallest width of the target, relative to the source's smallest

// Returns value `i` of `count` over a range, including its ends.
double part(const Range& range, std::size_t i, std::size_t count) {
  return range.min + (range.max - range.min) * static_cast<double>(i) / static_cast<double>(count - 1);
}

Range common(const Range& a, const Range& b) { return {std::max(a.min, b.min), std::min(a.max, b.max)}; }

Objective objective_of(const Fit& fit) {
  const auto found = fit.table.comments.find("objective");
  if (found == fit.table.comments.end())
    throw input_error(fit.id + ": its table does not state an objective (use the fit of a sweep)");
  return recorded_objective(found->second);
}

ProbedModel probed(const PictureTaker& taker, const Renderer& renderer, const std::string& name,
                   const Range& alphas) {
  ProbedModel model{renderer.model(name), {}};
  model.response = specular_response(renderer, model.model);
  if (!model.response.affine()) model.curve = probe_family(taker, model.model, alphas);
  return model;
}

// A TargetWidths holds widths of a target that are 1 % apart, and at each width the pictures whose
// combinations give all others. Thread-safe.
class TargetWidths {
 public:
  TargetWidths(const PictureTaker& taker, ProbedModel target, double narrowest)
      : taker_(taker), target_(std::move(target)) {
    if (!target_.family())
      throw input_error(target_.model.name + ": its pictures follow no law that this study knows");
    const double least = std::max(target_.model.alpha.min, narrowest);
    for (double alpha = target_.model.alpha.max; alpha > least; alpha /= kAlphaRatio)
      alphas_.push_back(alpha);
    alphas_.push_back(least);
    pictures_.resize(alphas_.size());
    are_rendered_ = std::deque<std::once_flag>(alphas_.size());
  }

  std::size_t size() const { return alphas_.size(); }
  double alpha(std::size_t i) const { return alphas_[i]; }
  const ProbedModel& target() const { return target_; }
  // Renders the pictures on the first call.
  const std::vector<std::vector<float>>& pictures(std::size_t i) const {
    std::call_once(are_rendered_[i], [&] { pictures_[i] = take_family(taker_, target_, alphas_[i]); });
    return pictures_[i];
  }

 private:
  const PictureTaker& taker_;
  ProbedModel target_;
  std::vector<double> alphas_;
  // pictures of each width, empty until they are rendered
  mutable std::vector<std::vector<std::vector<float>>> pictures_;
  mutable std::deque<std::once_flag> are_rendered_;
};

// A Comparison compares a source picture with pictures of a target whose specular is free.
class Comparison {
 public:
  Comparison(const std::vector<float>& source, std::vector<float> weights, double error_factor)
      : source_(source),
        weights_(std::move(weights)),
        power_(product(source, source)),
        error_factor_(error_factor) {}

  // Returns the best specular of a width and its error, from the polynomial of the loss.
  std::pair<double, double> best(const std::vector<std::vector<float>>& pictures,
                                 const SpecularFamily& family) const {
    std::vector<double> loss = {power_};
    const auto add = [&](double factor, const std::vector<double>& polynomial) {
      loss.resize(std::max(loss.size(), polynomial.size()));
      for (std::size_t i = 0; i < polynomial.size(); ++i) loss[i] += factor * polynomial[i];
    };
    for (std::size_t j = 0; j < pictures.size(); ++j) {
      add(-2.0 * product(source_, pictures[j]), family.weights[j]);
      for (std::size_t k = j; k < pictures.size(); ++k)
        add((j == k ? 1.0 : 2.0) * product(pictures[j], pictures[k]),
            polynomial_product(family.weights[j], family.weights[k]));
    }
    const double least = polynomial_minima(loss, family.coordinate_range()).front();
    return {family.specular(least), relative(polynomial_value(loss, least))};
  }
  double error(const std::vector<float>& target) const {
    std::vector<float> difference(target.size());
    for (std::size_t i = 0; i < target.size(); ++i) difference[i] = target[i] - source_[i];
    return relative(product(difference, difference));
  }

 private:
  double product(const std::vector<float>& a, const std::vector<float>& b) const {
    return weighted_product(weights_.data(), a.data(), b.data(), a.size());
  }
  double relative(double loss) const { return error_factor_ * std::sqrt(std::max(0.0, loss) / power_); }

  const std::vector<float>& source_;
  std::vector<float> weights_;
  double power_, error_factor_;
};

// Returns the minimum of the parabola through three errors at equal steps, of which the middle one is the
// smallest. Uses squares of errors, because the squares are a parabola.
double least_between(double before, double middle, double after) {
  const double b = before * before, m = middle * middle, a = after * after;
  const double bend = b - 2.0 * m + a;
  return bend > 0.0 ? std::sqrt(std::max(0.0, m - 0.125 * (a - b) * (a - b) / bend)) : middle;
}

// Examines every sixth width. If one of these is not worse than both neighbours, examines all widths between
// its neighbours.
void find_least(const Comparison& comparison, const TargetWidths& target, ReachedMaterial* material) {
  const std::size_t count = target.size();
  const SpecularFamily family = target.target().family().value();
  std::vector<double> errors(count, INFINITY);
  const auto look_at = [&](std::size_t i) {
    if (std::isinf(errors[i])) errors[i] = comparison.best(target.pictures(i), family).second;
    return errors[i];
  };
  std::vector<std::size_t> coarse;
  for (std::size_t i = 0; i < count; i += kStride) coarse.push_back(i);
  if (coarse.back() + 1 != count) coarse.push_back(count - 1);
  for (std::size_t k = 0; k < coarse.size(); ++k) {
    const std::size_t from = coarse[k == 0 ? 0 : k - 1], to = coarse[std::min(k + 1, coarse.size() - 1)];
    if (look_at(coarse[k]) > look_at(from) || look_at(coarse[k]) > look_at(to)) continue;
    for (std::size_t i = from; i <= to; ++i) look_at(i);
  }
  const auto best = static_cast<std::size_t>(std::ranges::min_element(errors) - errors.begin());
  material->least_alpha = target.alpha(best);
  material->least_specular = comparison.best(target.pictures(best), family).first;
  material->least_error = best == 0 || best + 1 == count
                              ? errors[best]
                              : least_between(errors[best - 1], errors[best], errors[best + 1]);
}

class FitStudy {
 public:
  FitStudy(const Renderer& renderer, std::size_t index, const ReachOptions& options)
      : options_(options),
        fit_(options.fits[index]),
        objective_(objective_of(fit_)),
        taker_(renderer, objective_, options.resolution, 1),
        alphas_(common(options.alphas, renderer.model(fit_.source.model).alpha)),
        source_(probed(taker_, renderer, fit_.source.model, alphas_)),
        widths_(taker_, probed(taker_, renderer, fit_.target.model, alphas_), kNarrowest * alphas_.min),
        speculars_(options.speculars.empty() ? Range{0.0, source_.linear_range().max}
                                             : options.speculars[index]) {
    source_.exposure = parse_number(fit_.table.comment(kLightScaleComment)).value_or(1.0);
  }

  // Returns the materials of one source width.
  std::vector<ReachedMaterial> materials(std::size_t row) const {
    std::vector<ReachedMaterial> all;
    for (std::size_t k = 1; k <= options_.materials; ++k) {
      ReachedMaterial material;
      material.alpha = part(alphas_, row, options_.materials);
      material.specular = part(speculars_, k, options_.materials + 1);
      const std::vector<float> source = taker_.take(source_, {material.alpha, material.specular, 0.0});
      const Comparison comparison(source, taker_.weights(source).squared, objective_.error_factor());
      convert(&material);
      material.error = comparison.error(
          taker_.take(widths_.target(), {material.target_alpha, material.target_specular, 0.0}));
      find_least(comparison, widths_, &material);
      all.push_back(material);
    }
    return all;
  }

 private:
  void convert(ReachedMaterial* material) const {
    const double own = from_alpha(fit_.source.roughness, material->alpha);
    const double width = evaluate_texel(fit_, own, {&material->specular, 1}, {&material->target_specular, 1});
    material->target_alpha = to_alpha(fit_.target.roughness, width);
  }

  const ReachOptions& options_;
  const Fit& fit_;
  Objective objective_;
  PictureTaker taker_;
  Range alphas_;
  ProbedModel source_;
  TargetWidths widths_;
  Range speculars_;
};

}  // namespace

std::size_t progress_steps(const ReachOptions& options) { return options.fits.size() * options.materials; }

std::vector<std::vector<ReachedMaterial>> study_reach(const Renderer& renderer, const ReachOptions& options) {
  std::vector<std::vector<ReachedMaterial>> all(options.fits.size());
  for (std::size_t f = 0; f < options.fits.size(); ++f) {
    const FitStudy study(renderer, f, options);
    std::vector<std::vector<ReachedMaterial>> rows(options.materials);
    run_parallel(options.materials, options.jobs, [&](std::size_t row) {
      if (options.cancelled != nullptr && *options.cancelled)
        throw Error(ErrorKind::kInterrupted, "reach: interrupted; nothing was written");
      rows[row] = study.materials(row);
      if (options.progress) options.progress();
    });
    for (const auto& row : rows) all[f].insert(all[f].end(), row.begin(), row.end());
  }
  return all;
}

std::string reach_csv(const ReachOptions& options, const std::vector<std::vector<ReachedMaterial>>& result) {
  CsvText csv(
      "fit,alpha,specular,target_alpha,target_specular,error,least_alpha,least_specular,least_error",
      {{"tool", std::string("remap-study ") + kVersion}, {"resolution", std::to_string(options.resolution)}});
  for (std::size_t f = 0; f < result.size(); ++f)
    for (const ReachedMaterial& m : result[f])
      csv.add_row(options.fits[f].id, m.alpha, m.specular, m.target_alpha, m.target_specular, m.error,
                  m.least_alpha, m.least_specular, m.least_error);
  return csv.text();
}

}  // namespace remap
