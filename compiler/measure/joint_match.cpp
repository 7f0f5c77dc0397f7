#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "measure/function_cost.hpp"
#include "measure/match.hpp"
#include "measure/objective.hpp"

namespace remap {
namespace {

constexpr double kJointRivalError = 1.01;  // see kRivalError in match.cpp
// If all parameters of a rival differ by less than this fraction, it is the same answer.
constexpr double kJointRivalDistance = 0.1;
// A search ends at this relative change of the squared error. A search from a rival needs less precision,
// because its result is compared only to one percent.
constexpr double kAnswerTolerance = 1e-10;
constexpr double kRivalTolerance = 1e-7;
constexpr double kJointSameError = 1e-4;  // smaller errors come from rounding in pictures
constexpr double kBoundTolerance = 1e-6;  // as a fraction of the range

using Matrix = std::vector<std::vector<double>>;

Matrix square(std::size_t side) { return Matrix(side, std::vector<double>(side)); }

// Returns upper R with R^T R = gram; rows of linearly dependent columns are 0.
Matrix cholesky(const Matrix& gram) {
  Matrix r = square(gram.size());
  for (std::size_t i = 0; i < gram.size(); ++i) {
    for (std::size_t j = i; j < gram.size(); ++j) {
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
  if (!summary.IsSolutionUsable()) throw numeric_error("joint match: Ceres failed: " + summary.message);
  return summary;
}

double share_of(const Range& range, double share) { return range.min + share * (range.max - range.min); }

bool lies_at(double value, double bound, const Range& range) {
  return std::fabs(value - bound) <= kBoundTolerance * (range.max - range.min);
}

double power_of(const PictureWeights& weights, const std::vector<float>& picture) {
  return weighted_product(weights.squared.data(), picture.data(), picture.data(), picture.size());
}

double pixel_power(PictureWeights weights, const std::vector<float>& picture) {
  for (const std::size_t i : weights.means) weights.squared[i] = 0.0f;
  return power_of(weights, picture);
}

}  // namespace

JointMatcher::JointMatcher(const TargetPictures& target, std::vector<JointChannel> channels,
                           DiffuseSearch diffuse)
    : target_(target), channels_(std::move(channels)), diffuse_(diffuse), unknowns_(unknowns()) {
  wanted_.resize(target.coordinates().size());
  for (const Unknown& unknown : unknowns_) wanted_[unknown.coordinate] = true;
  for (const JointChannel& channel : channels_) power_ += power_of(channel.weights, channel.picture);
}

// Returns inner products of the tangents and, in the last row and column, of picture - source. They are
// summed over all channels and divided by the power of the source.
std::vector<std::vector<double>> JointMatcher::gram(const double* values, const RoleValues& guess) const {
  const std::size_t count = unknowns_.size();
  Matrix products = square(count + 1);
  const std::vector<RoleValues> points = points_of(values, guess);
  std::vector<PictureTangents> pictures = target_.at(points, wanted_);
  for (std::size_t c = 0; c < points.size(); ++c) {
    const JointChannel& channel = channels_[c];
    PictureTangents& tangents = pictures[c];
    for (std::size_t i = 0; i < channel.picture.size(); ++i) tangents.picture[i] -= channel.picture[i];
    std::vector<const float*> columns(count + 1, nullptr);  // null for the unknowns of other channels
    for (std::size_t u = 0; u < count; ++u)
      if (unknowns_[u].concerns(c)) columns[u] = tangents.by[unknowns_[u].coordinate].data();
    columns[count] = tangents.picture.data();
    for (std::size_t i = 0; i <= count; ++i)
      for (std::size_t j = i; j <= count; ++j)
        if (columns[i] != nullptr && columns[j] != nullptr)
          products[i][j] += weighted_product(channel.weights.squared.data(), columns[i], columns[j],
                                             channel.picture.size()) /
                            power_;
  }
  return products;
}

std::vector<JointMatcher::Unknown> JointMatcher::unknowns() const {
  std::vector<Unknown> all;
  for (std::size_t i = 0; i < target_.coordinates().size(); ++i) {
    const Coordinate& coordinate = target_.coordinates()[i];
    const bool kept = i == kDiffuseCoordinate && diffuse_ == DiffuseSearch::kNone;
    if (kept || !(coordinate.range.max > coordinate.range.min)) continue;
    for (std::size_t c = 0; c < (coordinate.shared ? 1 : channels_.size()); ++c)
      all.push_back({i, c, coordinate.shared});
  }
  return all;
}

std::vector<RoleValues> JointMatcher::points_of(const double* values, const RoleValues& guess) const {
  std::vector<RoleValues> points(channels_.size(), guess);
  for (std::size_t u = 0; u < unknowns_.size(); ++u)
    for (std::size_t c = 0; c < points.size(); ++c)
      if (unknowns_[u].concerns(c)) target_.set_value(&points[c], unknowns_[u].coordinate, values[u]);
  return points;
}

std::vector<RoleValues> JointMatcher::other_guesses() const {
  return {point_of({0.05, 0.1, 0.9}), point_of({0.15, 0.9, 0.1}), point_of({0.9, 0.1, 0.1}),
          point_of({0.3, 0.3, 0.7})};
}

RoleValues JointMatcher::point_of(const RoleValues& shares) const {
  RoleValues point;
  for (std::size_t i = 0; i < target_.coordinates().size(); ++i) {
    const double share = target_.value(shares, i % (kDiffuseCoordinate + 1));
    target_.set_value(&point, i, share_of(target_.coordinates()[i].range, share));
  }
  return point;
}

double JointMatcher::picture_error(std::span<const std::vector<float>> pictures) const {
  double loss = 0.0, power = 0.0;
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    std::vector<float> difference = pictures[c];
    for (std::size_t i = 0; i < difference.size(); ++i) difference[i] -= channels_[c].picture[i];
    loss += pixel_power(channels_[c].weights, difference);
    power += pixel_power(channels_[c].weights, channels_[c].picture);
  }
  return std::sqrt(loss / power);
}

Match JointMatcher::search(const RoleValues& guess, double tolerance) const {
  std::vector<double> values;
  ceres::Problem problem;
  for (const Unknown& unknown : unknowns_) {
    const Range& range = target_.coordinates()[unknown.coordinate].range;
    values.push_back(std::clamp(target_.value(guess, unknown.coordinate), range.min, range.max));
  }
  // The residuals of a whole picture are reduced to a few numbers. A trust-region step depends only on J^T J,
  // J^T r and r^T r. The triangle R of [J r] = Q R gives the same products, so Ceres gets the columns of R as
  // Jacobian and residual.
  const std::size_t count = unknowns_.size();
  std::vector<double> known;  // where `triangle` was computed
  Matrix triangle;
  const auto evaluate = [&](const double* at, double* residuals, double* jacobian) {
    // Ceres first evaluates the residuals of a step. If it accepts the step, it evaluates the Jacobian at the
    // same point.
    if (known.empty() || !std::equal(known.begin(), known.end(), at)) triangle = cholesky(gram(at, guess));
    known.assign(at, at + count);
    for (std::size_t row = 0; row <= count; ++row) {
      residuals[row] = triangle[row][count];
      if (!std::isfinite(residuals[row])) return false;
      for (std::size_t column = 0; jacobian != nullptr && column < count; ++column)
        jacobian[row * count + column] = triangle[row][column];
    }
    return true;
  };
  problem.AddResidualBlock(new FunctionCost(count + 1, count, evaluate), nullptr, values.data());
  for (std::size_t u = 0; u < values.size(); ++u) {
    const Range& range = target_.coordinates()[unknowns_[u].coordinate].range;
    problem.SetParameterLowerBound(values.data(), static_cast<int>(u), range.min);
    problem.SetParameterUpperBound(values.data(), static_cast<int>(u), range.max);
  }
  ceres::Solver::Summary summary = solve(&problem, tolerance);
  // Ceres projects steps into the bounds and converges slowly along them. So parameters at a bound are fixed,
  // and the search for the others is repeated.
  std::vector<int> fixed;
  for (std::size_t u = 0; u < values.size(); ++u) {
    const Range& range = target_.coordinates()[unknowns_[u].coordinate].range;
    for (const double bound : {range.min, range.max}) {
      if (!lies_at(values[u], bound, range)) continue;
      values[u] = bound;
      fixed.push_back(static_cast<int>(u));
    }
  }
  if (!fixed.empty() && fixed.size() < values.size()) {
    problem.SetManifold(values.data(), new ceres::SubsetManifold(static_cast<int>(values.size()), fixed));
    summary = solve(&problem, tolerance);
  }
  return {points_of(values.data(), guess), std::sqrt(2.0 * summary.final_cost), 0.0, RowStatus::kOk,
          summary.termination_type == ceres::CONVERGENCE};
}

bool JointMatcher::apart(const Match& a, const Match& b) const {
  return std::ranges::any_of(unknowns_, [&](const Unknown& unknown) {
    const double x = target_.value(a.points[unknown.channel], unknown.coordinate);
    const double y = target_.value(b.points[unknown.channel], unknown.coordinate);
    const Range& range = target_.coordinates()[unknown.coordinate].range;
    return std::fabs(x - y) > kJointRivalDistance * std::max({x, y, 0.01 * range.max});
  });
}

bool JointMatcher::at_bound(const Match& match) const {
  return std::ranges::any_of(unknowns_, [&](const Unknown& unknown) {
    const double value = target_.value(match.points[unknown.channel], unknown.coordinate);
    const Range& range = target_.coordinates()[unknown.coordinate].range;
    const bool may_be_least =
        unknown.coordinate == kDiffuseCoordinate && diffuse_ == DiffuseSearch::kOfBlackDiffuse;
    return lies_at(value, range.max, range) || (!may_be_least && lies_at(value, range.min, range));
  });
}

RowStatus JointMatcher::judge(const Match& match, const std::vector<Match>& rivals) const {
  if (!match.converged) return RowStatus::kUnstable;
  for (const Match& rival : rivals) {
    const bool better = kJointRivalError * rival.error + kJointSameError < match.error;
    const bool as_good = rival.error < kJointRivalError * match.error + kJointSameError;
    if (better || (as_good && apart(rival, match))) return RowStatus::kUnstable;
  }
  return at_bound(match) && match.error > kJointSameError ? RowStatus::kClamped : RowStatus::kOk;
}

Match JointMatcher::match(const std::vector<RoleValues>& guesses,
                          const std::vector<RoleValues>& rivals) const {
  std::vector<Match> found;
  for (const RoleValues& guess : guesses) found.push_back(search(guess, kAnswerTolerance));
  Match best = *std::ranges::min_element(found, {}, &Match::error);
  for (const RoleValues& rival : rivals) found.push_back(search(rival, kRivalTolerance));
  best.status = judge(best, found);
  std::vector<std::vector<float>> pictures;
  for (PictureTangents& tangents : target_.at(best.points, std::vector<bool>(wanted_.size())))
    pictures.push_back(std::move(tangents.picture));
  best.picture_error = picture_error(pictures);
  return best;
}

}  // namespace remap
