#include "sweep/joint_match.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <ceres/ceres.h>

#include "error.hpp"
#include "sweep/picture_sums.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;
using remap::Range;

// Other guesses, as shares: narrow and wide, weak and strong, bright and dark. They never make the answer of
// match_from; they tell whether it is the only one.
constexpr std::array<Sitting, 4> kOtherGuesses = {Sitting{0.05, 0.1, 0.9}, Sitting{0.15, 0.9, 0.1},
                                                  Sitting{0.9, 0.1, 0.1}, Sitting{0.3, 0.3, 0.7}};
constexpr double kRivalError = 1.01;    // as for the two-stage match
constexpr double kRivalDistance = 0.1;  // relative, in a parameter
// Relative change of the squared error at which a search ends: of one that gives the answer, and of one that
// is only compared with it to 1 %.
constexpr double kAnswerTolerance = 1e-10;
constexpr double kRivalTolerance = 1e-7;
constexpr double kSameError = 1e-4;       // errors below this are rounding of pictures
constexpr double kBoundTolerance = 1e-6;  // share of the range

constexpr std::size_t kMostParameters = 3;
constexpr std::size_t kMostColumns = kMostParameters + 1;
using Triangle = std::array<std::array<double, kMostColumns>, kMostColumns>;

// Upper R with R^T R = gram, for the first `count` columns; rows of dependent columns are 0.
Triangle cholesky(const Triangle& gram, std::size_t count) {
  Triangle r{};
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i; j < count; ++j) {
      double left = gram[i][j];
      for (std::size_t k = 0; k < i; ++k) left -= r[k][i] * r[k][j];
      if (i == j)
        r[i][i] = left > 1e-14 * gram[i][i] ? std::sqrt(left) : 0.0;
      else
        r[i][j] = r[i][i] > 0.0 ? left / r[i][i] : 0.0;
    }
  }
  return r;
}

Sitting sitting_of(const double* values, std::size_t count, double diffuse) {
  return {values[0], values[1], count == kMostParameters ? values[2] : diffuse};
}

// The residuals of a whole picture as four numbers. A trust-region step depends on J^T J, J^T r and r^T r
// alone, and the triangle R of [J r] = Q R has the same: its columns stand for the Jacobian and the residual.
class PictureCost final : public ceres::CostFunction {
 public:
  PictureCost(const TargetPictures& target, const std::vector<float>& source,
              const std::vector<float>& weights, double power, std::size_t parameters, double diffuse)
      : target_(target),
        source_(source),
        weights_(weights),
        power_(power),
        parameters_(parameters),
        diffuse_(diffuse) {
    set_num_residuals(static_cast<int>(parameters + 1));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(parameters));
  }

  bool Evaluate(double const* const* values, double* residuals, double** jacobians) const override {
    const Triangle& r = triangle(sitting_of(values[0], parameters_, diffuse_));
    for (std::size_t row = 0; row <= parameters_; ++row) {
      residuals[row] = r[row][parameters_];
      if (!std::isfinite(residuals[row])) return false;
      for (std::size_t column = 0; jacobians != nullptr && jacobians[0] != nullptr && column < parameters_;
           ++column)
        jacobians[0][row * parameters_ + column] = r[row][column];
    }
    return true;
  }

 private:
  // Ceres asks for residuals where it tries a step, and for the Jacobian at the same point where it takes it.
  const Triangle& triangle(const Sitting& point) const {
    const bool known = last_point_ && last_point_->alpha == point.alpha &&
                       last_point_->specular == point.specular && last_point_->diffuse == point.diffuse;
    if (!known) last_triangle_ = cholesky(gram(point), parameters_ + 1);
    last_point_ = point;
    return last_triangle_;
  }

  // Inner products of the tangents and, last, of picture - source, relative to the power of the source.
  Triangle gram(const Sitting& point) const {
    PictureTangents tangents = target_.at(point, parameters_ == kMostParameters);
    for (std::size_t i = 0; i < source_.size(); ++i) tangents.picture[i] -= source_[i];
    std::array<const float*, kMostColumns> columns{tangents.by_alpha.data(), tangents.by_specular.data(),
                                                   tangents.by_diffuse.data(), nullptr};
    columns[parameters_] = tangents.picture.data();
    Triangle products{};
    for (std::size_t i = 0; i <= parameters_; ++i)
      for (std::size_t j = i; j <= parameters_; ++j)
        products[i][j] = weighted_product(weights_.data(), columns[i], columns[j], source_.size()) / power_;
    return products;
  }

  const TargetPictures& target_;
  const std::vector<float>& source_;
  const std::vector<float>& weights_;
  double power_;
  std::size_t parameters_;
  double diffuse_;
  mutable std::optional<Sitting> last_point_;
  mutable Triangle last_triangle_{};
};

ceres::Solver::Options solver_options(double tolerance) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 100;
  options.function_tolerance = tolerance;
  options.gradient_tolerance = 1e-12;
  options.parameter_tolerance = 1e-8;
  return options;
}

ceres::Solver::Summary solve(ceres::Problem* problem, double tolerance) {
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options(tolerance), problem, &summary);
  if (!summary.IsSolutionUsable())
    throw Error(ErrorKind::kNumeric, "joint match: Ceres gave up: " + summary.message);
  return summary;
}

double share_of(const Range& range, double share) { return range.min + share * (range.max - range.min); }

bool lies_at(double value, double bound, const Range& range) {
  return std::fabs(value - bound) <= kBoundTolerance * (range.max - range.min);
}

}  // namespace

JointMatcher::JointMatcher(const TargetPictures& target, std::vector<float> source,
                           std::vector<float> squared_weights, const JointOptions& options)
    : target_(target),
      source_(std::move(source)),
      weights_(std::move(squared_weights)),
      options_(options),
      power_(weighted_product(weights_.data(), source_.data(), source_.data(), source_.size())) {}

Sitting JointMatcher::point_of(const Sitting& shares) const {
  return {share_of(target_.alphas(), shares.alpha), share_of(target_.speculars(), shares.specular),
          share_of(target_.diffuses(), shares.diffuse)};
}

double JointMatcher::error_of(std::span<const float> picture) const {
  std::vector<float> difference(picture.begin(), picture.end());
  for (std::size_t i = 0; i < source_.size(); ++i) difference[i] -= source_[i];
  return std::sqrt(weighted_product(weights_.data(), difference.data(), difference.data(), source_.size()) /
                   power_);
}

JointMatch JointMatcher::search(const Sitting& guess, double tolerance) const {
  const std::size_t count = options_.free_diffuse ? kMostParameters : kMostParameters - 1;
  const std::array<Range, kMostParameters> ranges = {target_.alphas(), target_.speculars(),
                                                     target_.diffuses()};
  std::array<double, kMostParameters> values = {guess.alpha, guess.specular, guess.diffuse};
  ceres::Problem problem;
  problem.AddResidualBlock(new PictureCost(target_, source_, weights_, power_, count, guess.diffuse), nullptr,
                           values.data());
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = std::clamp(values[i], ranges[i].min, ranges[i].max);
    problem.SetParameterLowerBound(values.data(), static_cast<int>(i), ranges[i].min);
    problem.SetParameterUpperBound(values.data(), static_cast<int>(i), ranges[i].max);
  }
  ceres::Solver::Summary summary = solve(&problem, tolerance);
  // Ceres projects steps into the bounds and creeps along them. Parameters that have reached one stay there
  // while the others are searched once more.
  std::vector<int> fixed;
  for (std::size_t i = 0; i < count; ++i)
    for (const double bound : {ranges[i].min, ranges[i].max}) {
      if (!lies_at(values[i], bound, ranges[i])) continue;
      values[i] = bound;
      fixed.push_back(static_cast<int>(i));
    }
  if (!fixed.empty() && fixed.size() < count) {
    problem.SetManifold(values.data(), new ceres::SubsetManifold(static_cast<int>(count), fixed));
    summary = solve(&problem, tolerance);
  }
  return {sitting_of(values.data(), count, guess.diffuse), std::sqrt(2.0 * summary.final_cost),
          summary.termination_type == ceres::CONVERGENCE, RowStatus::kOk};
}

bool JointMatcher::apart(const Sitting& a, const Sitting& b) const {
  const auto differ = [](double x, double y, const Range& range) {
    return std::fabs(x - y) > kRivalDistance * std::max({x, y, 0.01 * range.max});
  };
  return differ(a.alpha, b.alpha, target_.alphas()) || differ(a.specular, b.specular, target_.speculars()) ||
         (options_.free_diffuse && differ(a.diffuse, b.diffuse, target_.diffuses()));
}

bool JointMatcher::at_bound(const Sitting& point) const {
  const Range &alphas = target_.alphas(), &speculars = target_.speculars(), &diffuses = target_.diffuses();
  if (lies_at(point.alpha, alphas.min, alphas) || lies_at(point.alpha, alphas.max, alphas)) return true;
  if (lies_at(point.specular, speculars.min, speculars) || lies_at(point.specular, speculars.max, speculars))
    return true;
  if (!options_.free_diffuse) return false;
  return lies_at(point.diffuse, diffuses.max, diffuses) ||
         (options_.source_has_diffuse && lies_at(point.diffuse, diffuses.min, diffuses));
}

RowStatus JointMatcher::judge(const JointMatch& match, const std::vector<JointMatch>& rivals) const {
  if (!match.converged) return RowStatus::kUnstable;
  for (const JointMatch& rival : rivals) {
    const bool better = kRivalError * rival.error + kSameError < match.error;
    const bool as_good = rival.error < kRivalError * match.error + kSameError;
    if (better || (as_good && apart(rival.point, match.point))) return RowStatus::kUnstable;
  }
  return at_bound(match.point) ? RowStatus::kClamped : RowStatus::kOk;
}

JointMatch JointMatcher::match_from(const Sitting& guess) const {
  JointMatch match = search(guess, kAnswerTolerance);
  std::vector<JointMatch> rivals;
  for (const Sitting& shares : kOtherGuesses) rivals.push_back(search(point_of(shares), kRivalTolerance));
  match.status = judge(match, rivals);
  return match;
}

JointMatch JointMatcher::best_match(const std::vector<Sitting>& guesses) const {
  std::vector<JointMatch> found;
  for (const Sitting& guess : guesses) found.push_back(search(guess, kAnswerTolerance));
  JointMatch best = *std::min_element(
      found.begin(), found.end(), [](const JointMatch& a, const JointMatch& b) { return a.error < b.error; });
  best.status = judge(best, found);
  return best;
}

}  // namespace remapc
