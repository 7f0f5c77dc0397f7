#include "fit/parametric.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <Eigen/Dense>
#include <ceres/ceres.h>

#include "error.hpp"
#include "model/interpreter.hpp"
#include "number_text.hpp"

namespace remapc {
namespace {

using remap::Error;
using remap::ErrorKind;
using remap::number_text;
using remap::Parametric;
using remap::Range;

constexpr std::size_t kFewestAlphas = 6;
// Rates that the search starts from: from straight lines over the domain to the narrowest bump a grid shows.
constexpr std::array<double, 12> kStartRates = {0.0, 0.25, 0.5,  1.0,  2.0,   4.0,
                                                8.0, 16.0, 32.0, 64.0, 256.0, 1024.0};
constexpr std::size_t kPolishedStarts = 4;

// The slope of specular2 over specular1 at one source width, and how much it counts.
struct SlopeSample {
  double alpha;
  double slope;
  double weight;  // root of the sum of squared speculars
};

std::vector<SlopeSample> slope_samples(const std::vector<TableRow>& rows) {
  std::map<double, std::array<double, 2>> sums;  // alpha -> sum of s1 s2, sum of s1^2
  for (const TableRow& row : rows) {
    auto& [cross, square] = sums[row.alpha1];
    cross += row.specular1 * row.specular2;
    square += row.specular1 * row.specular1;
  }
  std::vector<SlopeSample> samples;
  for (const auto& [alpha, sum] : sums)
    if (sum[1] > 0.0) samples.push_back({alpha, sum[0] / sum[1], std::sqrt(sum[1])});
  if (samples.size() < kFewestAlphas)
    throw Error(ErrorKind::kInput, "fit: the training rows have " + std::to_string(samples.size()) +
                                       " different alpha1; expected at least " +
                                       std::to_string(kFewestAlphas));
  return samples;
}

std::array<double, 4> fit_quartic(const std::vector<TableRow>& rows) {
  Eigen::MatrixXd powers(static_cast<Eigen::Index>(rows.size()), 4);
  Eigen::VectorXd target(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    double power = 1.0;
    for (Eigen::Index j = 0; j < 4; ++j) powers(row, j) = power *= rows[i].alpha1;
    target(row) = rows[i].alpha2;
  }
  const Eigen::Vector4d solution = powers.colPivHouseholderQr().solve(target);
  return {solution[0], solution[1], solution[2], solution[3]};
}

// phi of the Parametric kind for doubles and for Ceres' dual numbers; the series keeps its derivative by the
// rate exact near 0, where the closed form is 0 / 0.
template <typename Scalar>
Scalar rise(const Scalar& rate, double x) {
  using std::exp;
  const Scalar y = rate * x;
  if (y < 1e-3) return x * (1.0 - y * (1.0 / 2.0 - y * (1.0 / 6.0 - y * (1.0 / 24.0 - y / 120.0))));
  return (1.0 - exp(-y)) / rate;
}

// Residual of one slope sample in start, ramp, ramp_rate, bump, bump_rate.
struct SlopeResidual {
  SlopeSample sample;
  template <typename Scalar>
  bool operator()(const Scalar* c, Scalar* residual) const {
    const double alpha = sample.alpha;
    residual[0] =
        sample.weight * (c[0] + c[1] * rise(c[2], alpha) + c[3] * rise(c[4], alpha * alpha) - sample.slope);
    return true;
  }
};

struct SlopeFit {
  std::array<double, 5> coefficients{};  // as in SlopeResidual
  double cost = std::numeric_limits<double>::infinity();
};

// The best start, ramp and bump for given rates: linear least squares.
SlopeFit solve_linear(const std::vector<SlopeSample>& samples, double ramp_rate, double bump_rate) {
  Eigen::MatrixXd basis(static_cast<Eigen::Index>(samples.size()), 3);
  Eigen::VectorXd target(static_cast<Eigen::Index>(samples.size()));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const SlopeSample& sample = samples[i];
    basis(row, 0) = sample.weight;
    basis(row, 1) = sample.weight * rise(ramp_rate, sample.alpha);
    basis(row, 2) = sample.weight * rise(bump_rate, sample.alpha * sample.alpha);
    target(row) = sample.weight * sample.slope;
  }
  const Eigen::Vector3d c = basis.colPivHouseholderQr().solve(target);
  return {{c[0], c[1], ramp_rate, c[2], bump_rate}, 0.5 * (basis * c - target).squaredNorm()};
}

SlopeFit polish(const std::vector<SlopeSample>& samples, SlopeFit fit) {
  ceres::Problem problem;
  for (const SlopeSample& sample : samples)
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<SlopeResidual, 1, 5>(new SlopeResidual{sample}),
                             nullptr, fit.coefficients.data());
  problem.SetParameterLowerBound(fit.coefficients.data(), 2, 0.0);
  problem.SetParameterLowerBound(fit.coefficients.data(), 4, 0.0);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 400;
  options.function_tolerance = 1e-12;
  options.parameter_tolerance = 1e-12;
  options.gradient_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable() || !std::isfinite(summary.final_cost)) return {};
  fit.cost = summary.final_cost;
  return fit;
}

SlopeFit fit_slopes(const std::vector<SlopeSample>& samples) {
  std::vector<SlopeFit> starts;
  for (const double ramp_rate : kStartRates)
    for (const double bump_rate : kStartRates) starts.push_back(solve_linear(samples, ramp_rate, bump_rate));
  std::stable_sort(starts.begin(), starts.end(),
                   [](const SlopeFit& a, const SlopeFit& b) { return a.cost < b.cost; });
  SlopeFit best;
  for (std::size_t i = 0; i < kPolishedStarts; ++i) {
    const SlopeFit candidate = polish(samples, starts[i]);
    if (candidate.cost < best.cost) best = candidate;
  }
  if (!std::isfinite(best.cost))
    throw Error(ErrorKind::kNumeric,
                "fit: k(alpha) did not converge from any start; look at the table with remapc check");
  return best;
}

// The alpha in `domain` at which the curve rises least: an end, or a root of the second derivative.
double flattest_alpha(const Parametric& form, const Range& domain) {
  const auto& r = form.roughness;
  std::vector<double> candidates = {domain.min, domain.max};
  const double a = 12.0 * r[3], b = 6.0 * r[2], c = 2.0 * r[1];
  const double discriminant = b * b - 4.0 * a * c;
  if (a != 0.0 && discriminant >= 0.0) {
    candidates.push_back((-b + std::sqrt(discriminant)) / (2.0 * a));
    candidates.push_back((-b - std::sqrt(discriminant)) / (2.0 * a));
  } else if (a == 0.0 && b != 0.0) {
    candidates.push_back(-c / b);
  }
  double flattest = domain.min;
  for (const double alpha : candidates)
    if (domain.contains(alpha) &&
        remap::roughness_derivative(form, alpha) < remap::roughness_derivative(form, flattest))
      flattest = alpha;
  return flattest;
}

void require_sound(const Parametric& form, const Range& domain) {
  const double flattest = flattest_alpha(form, domain);
  const double rise_there = remap::roughness_derivative(form, flattest);
  if (!(rise_there > 0.0))
    throw Error(ErrorKind::kNumeric, "fit: the roughness curve bends: its slope is " +
                                         number_text(rise_there) + " at alpha1 " + number_text(flattest) +
                                         "; expected a rising curve on " + number_text(domain.min) + " to " +
                                         number_text(domain.max));
  constexpr int kSteps = 1000;
  for (int i = 0; i <= kSteps; ++i) {
    const double alpha = domain.min + (domain.max - domain.min) * i / kSteps;
    const double k = remap::specular_slope(form, alpha);
    if (!(k > 0.0))
      throw Error(ErrorKind::kNumeric, "fit: k(alpha) is " + number_text(k) + " at alpha1 " +
                                           number_text(alpha) + "; expected a positive factor");
  }
}

}  // namespace

Parametric fit_parametric(const std::vector<TableRow>& rows, const Range& domain) {
  const std::vector<SlopeSample> samples = slope_samples(rows);
  Parametric form;
  form.roughness = fit_quartic(rows);
  const SlopeFit slopes = fit_slopes(samples);
  form.start = slopes.coefficients[0];
  form.ramp = slopes.coefficients[1];
  form.ramp_rate = slopes.coefficients[2];
  form.bump = slopes.coefficients[3];
  form.bump_rate = slopes.coefficients[4];
  require_sound(form, domain);
  return form;
}

}  // namespace remapc
