#include "study/reach.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/parallel.hpp"
#include "lower/interpreter.hpp"
#include "measure/picture_sums.hpp"
#include "measure/picture_taker.hpp"
#include "measure/sweep.hpp"

namespace remap {
namespace {

constexpr double kAlphaRatio = 1.01;  // of neighbouring widths of the target
constexpr std::size_t kStride = 6;    // of those that are looked at first
constexpr double kNarrowest = 0.25;   // width of the target, relative to the source's least

// Value `i` of `count` over a range, the ends included.
double part(const Range& range, std::size_t i, std::size_t count) {
  return range.min + (range.max - range.min) * static_cast<double>(i) / static_cast<double>(count - 1);
}

Objective objective_of(const Fit& fit) {
  const auto found = fit.table.comments.find("objective");
  if (found == fit.table.comments.end())
    throw input_error(fit.id + ": its table does not name an objective (use the fit of a sweep)");
  return recorded_objective(found->second);
}

// The widths of a target with the two pictures of each, and the range of its specular.
struct TargetWidths {
  std::vector<double> alphas;
  std::vector<AffinePictures> pictures;
  Range speculars;
};

ProbedModel probed(const Renderer& renderer, const std::string& name) {
  const ModelDescription model = renderer.model(name);
  return {model, specular_response(renderer, model)};
}

TargetWidths target_widths(const PictureTaker& taker, const ProbedModel& target, double narrowest) {
  TargetWidths widths;
  widths.speculars = target.linear_range();
  const double least = std::max(target.model.alpha.min, narrowest);
  for (double alpha = target.model.alpha.max; alpha > least; alpha /= kAlphaRatio)
    widths.alphas.push_back(alpha);
  widths.alphas.push_back(least);
  for (const double alpha : widths.alphas) widths.pictures.push_back(take_affine(taker, target, alpha));
  return widths;
}

// The difference of a source picture from those of a target whose specular is free.
class Comparison {
 public:
  Comparison(const std::vector<float>& source, std::vector<float> weights, double error_factor)
      : source_(source),
        weights_(std::move(weights)),
        power_(product(source, source)),
        error_factor_(error_factor) {}

  struct Best {
    double specular = 0.0, error = 0.0;
  };
  // The best specular of a width is at the foot of a parabola, or at the end of the range.
  Best best(const AffinePictures& target, const Range& speculars) const {
    const double slope = product(target.slope, target.slope);
    const double cross = product(target.slope, source_) - product(target.slope, target.base);
    const double specular = std::clamp(cross / slope, speculars.min, speculars.max);
    const double base = power_ - 2.0 * product(source_, target.base) + product(target.base, target.base);
    return {specular, relative(base - 2.0 * specular * cross + specular * specular * slope)};
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

// The least value of the parabola through three errors at equal steps, the middle one least, in squares:
// there losses are parabolas.
double least_between(double before, double middle, double after) {
  const double b = before * before, m = middle * middle, a = after * after;
  const double bend = b - 2.0 * m + a;
  return bend > 0.0 ? std::sqrt(std::max(0.0, m - 0.125 * (a - b) * (a - b) / bend)) : middle;
}

// Looks at every sixth width, then at all around those that are better than their neighbours.
void find_least(const Comparison& comparison, const TargetWidths& target, ReachedMaterial* material) {
  const std::size_t count = target.alphas.size();
  std::vector<double> errors(count, INFINITY);
  const auto look_at = [&](std::size_t i) {
    if (std::isinf(errors[i])) errors[i] = comparison.best(target.pictures[i], target.speculars).error;
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
  material->least_alpha = target.alphas[best];
  material->least_specular = comparison.best(target.pictures[best], target.speculars).specular;
  material->least_error = best == 0 || best + 1 == count
                              ? errors[best]
                              : least_between(errors[best - 1], errors[best], errors[best + 1]);
}

class FitStudy {
 public:
  FitStudy(const Renderer& renderer, const Fit& fit, const ReachOptions& options)
      : options_(options),
        fit_(fit),
        objective_(objective_of(fit)),
        taker_(renderer, objective_, options.resolution, 1),
        source_(probed(renderer, fit.source.model)),
        target_(probed(renderer, fit.target.model)),
        widths_(target_widths(taker_, target_, kNarrowest * options.alphas.min)) {}

  // The materials of one source width.
  std::vector<ReachedMaterial> materials(std::size_t row) const {
    std::vector<ReachedMaterial> all;
    const double alpha = part(options_.alphas, row, options_.materials);
    const AffinePictures pictures = take_affine(taker_, source_, alpha);
    std::vector<float> source(pictures.base.size());
    for (std::size_t k = 1; k <= options_.materials; ++k) {
      ReachedMaterial material;
      material.alpha = alpha;
      material.specular =
          source_.linear_range().max * static_cast<double>(k) / static_cast<double>(options_.materials);
      for (std::size_t i = 0; i < source.size(); ++i)
        source[i] = pictures.base[i] + static_cast<float>(material.specular) * pictures.slope[i];
      const Comparison comparison(source, taker_.weights(source), objective_.error_factor());
      convert(&material);
      material.error =
          comparison.error(taker_.take(target_, {material.target_alpha, material.target_specular, 0.0}));
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
  ProbedModel source_, target_;
  TargetWidths widths_;
};

}  // namespace

std::size_t progress_steps(const ReachOptions& options) { return options.fits.size() * options.materials; }

double FitReach::mean_excess() const {
  double sum = 0.0;
  for (const ReachedMaterial& material : materials) sum += material.excess();
  return sum / static_cast<double>(materials.size());
}

const ReachedMaterial& FitReach::worst() const {
  return *std::ranges::max_element(materials, {}, &ReachedMaterial::excess);
}

std::vector<FitReach> study_reach(const Renderer& renderer, const ReachOptions& options) {
  std::vector<FitReach> all;
  for (std::size_t f = 0; f < options.fits.size(); ++f) {
    const FitStudy study(renderer, options.fits[f], options);
    std::vector<std::vector<ReachedMaterial>> rows(options.materials);
    run_parallel(options.materials, options.jobs, [&](std::size_t row) {
      if (options.cancelled != nullptr && *options.cancelled)
        throw Error(ErrorKind::kInterrupted, "reach: interrupted; nothing was written");
      rows[row] = study.materials(row);
      if (options.progress) options.progress();
    });
    FitReach reach{f, {}};
    for (const auto& row : rows) reach.materials.insert(reach.materials.end(), row.begin(), row.end());
    all.push_back(std::move(reach));
  }
  return all;
}

}  // namespace remap
