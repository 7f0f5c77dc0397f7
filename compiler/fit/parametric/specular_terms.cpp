#include "fit/parametric/specular_terms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <Eigen/Dense>
#include <ceres/ceres.h>

#include "core/errors.hpp"
#include "lower/evaluate.hpp"

namespace remap {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kFewestAlphas = 6;
// The search starts at these rates, from straight lines to the narrowest bump that a table resolves.
constexpr std::array<double, 12> kStartRates = {0.0, 0.25, 0.5,  1.0,  2.0,   4.0,
                                                8.0, 16.0, 32.0, 64.0, 256.0, 1024.0};
// At the second smallest alpha of a table, an exponential must be at least exp(-kLargestDecay). If it falls
// faster, it only follows the rows of the smallest alpha.
constexpr double kLargestDecay = 5.0;
// This is the cost, as an rms error, of a contribution of 1 at the largest alpha. It is small compared with
// the error of a fit. But it prevents curves of magnitude 1000 that cancel each other.
constexpr double kContributionPenalty = 1e-6;
constexpr std::size_t kPolishedStarts = 4;
constexpr std::size_t kStartAlphas = 256;  // alphas for the grid of starts, evenly drawn

using RowsByAlpha = std::map<double, std::vector<const TableRow*>>;

MatrixXd specular_powers(const std::vector<const TableRow*>& rows, const std::vector<int>& powers) {
  MatrixXd values(static_cast<Index>(rows.size()), static_cast<Index>(powers.size()));
  for (Index i = 0; i < values.rows(); ++i)
    for (Index t = 0; t < values.cols(); ++t)
      values(i, t) =
          std::pow(rows[static_cast<std::size_t>(i)]->specular1, powers[static_cast<std::size_t>(t)]);
  return values;
}

// Returns the derivative of phi(rate, x) by the rate. Uses the series if the closed formula is 0 / 0.
double rise_derivative(double rate, double x) {
  const double y = rate * x;
  if (y < 1e-3) return -x * x * (1.0 / 2.0 - y * (1.0 / 3.0 - y * (1.0 / 8.0 - y / 30.0)));
  return (y * std::exp(-y) + std::expm1(-y)) / (rate * rate);
}

// VariableProjection gives the squared error as a function of the rates only. The other coefficients are the
// least squares solution for these rates (Golub and Pereyra 1973). The Jacobian is Kaufman's (1975), whose
// gradient is exact. The rates are ramp_rate and bump_rate of each term, in this order.
class VariableProjection : public ceres::CostFunction {
 public:
  // Combines the rows of each alpha, of which there are two or more. If f holds the values of the curves at
  // alpha, |weights f - target|^2 is their squared error up to a constant. A QR decomposition of the powers
  // of specular makes this exact.
  VariableProjection(const RowsByAlpha& by_alpha, const ParametricForm& form)
      : form_(form),
        first_alpha_(by_alpha.begin()->first),
        second_alpha_(std::next(by_alpha.begin())->first),
        last_alpha_(by_alpha.rbegin()->first) {
    const auto terms = static_cast<Index>(form.powers.size());
    Index count = 0;
    for (const auto& [alpha, rows] : by_alpha) count += std::min(static_cast<Index>(rows.size()), terms);
    alpha_.resize(count);
    weights_.resize(count, terms);
    target_ = VectorXd::Zero(size());
    Index next = 0;
    double row_count = 0.0;
    for (const auto& [alpha, rows] : by_alpha) {
      MatrixXd left = specular_powers(rows, form.powers);
      VectorXd right(left.rows());
      for (Index i = 0; i < right.size(); ++i) right[i] = rows[static_cast<std::size_t>(i)]->specular2;
      const Index kept = std::min(left.rows(), terms);
      if (left.rows() > terms) {
        const Eigen::HouseholderQR<MatrixXd> qr(left);
        right = qr.householderQ().adjoint() * right;
        left = qr.matrixQR().topRows(terms).triangularView<Eigen::Upper>();
      }
      alpha_.segment(next, kept).setConstant(alpha);
      weights_.middleRows(next, kept) = left.topRows(kept);
      target_.segment(next, kept) = right.head(kept);
      row_count += static_cast<double>(rows.size());
      next += kept;
    }
    penalty_ = kContributionPenalty * std::sqrt(row_count);
    set_num_residuals(static_cast<int>(size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(2 * term_count()));
  }

  Index size() const { return sample_count() + column_count(); }
  double largest_rate(bool bump) const {
    const double alpha = second_alpha_;
    return kLargestDecay / (bump ? alpha * alpha : alpha);
  }
  std::size_t term_count() const { return form_.powers.size(); }
  std::size_t slope_term() const {
    return static_cast<std::size_t>(std::find(form_.powers.begin(), form_.powers.end(), 1) -
                                    form_.powers.begin());
  }

  // Returns one row for each sample, and then one row for each column, for the penalty.
  MatrixXd basis(const std::vector<double>& rates) const {
    const Index terms = weights_.cols(), count = sample_count();
    MatrixXd columns = MatrixXd::Zero(size(), column_count());
    for (Index t = 0; t < terms; ++t) {
      const auto term = static_cast<std::size_t>(t);
      const double ramp_rate = rates[2 * term], bump_rate = rates[2 * term + 1];
      for (Index i = 0; i < count; ++i) {
        const double alpha = alpha_[i], weight = weights_(i, t);
        columns(i, 3 * t) = form_.is_repeated(term) ? 0.0 : weight;
        columns(i, 3 * t + 1) = weight * rise(ramp_rate, alpha);
        columns(i, 3 * t + 2) = weight * rise(bump_rate, alpha * alpha);
      }
      const double last = last_alpha_;
      columns(count + 3 * t, 3 * t) = penalty_;
      columns(count + 3 * t + 1, 3 * t + 1) = penalty_ * rise(ramp_rate, last);
      columns(count + 3 * t + 2, 3 * t + 2) = penalty_ * rise(bump_rate, last * last);
    }
    if (form_.pole) {
      columns.col(3 * terms).head(count) =
          weights_.col(static_cast<Index>(slope_term())).cwiseQuotient(alpha_);
      columns(count + 3 * terms, 3 * terms) = penalty_ / first_alpha_;
    }
    return columns;
  }

  double cost(const std::vector<double>& rates) const {
    const MatrixXd columns = basis(rates);
    const VectorXd coefficients = columns.colPivHouseholderQr().solve(target_);
    return (columns * coefficients - target_).squaredNorm();
  }

  // Computes the residuals and, if Ceres asks for it, their derivatives by each rate.
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const std::vector<double> rates(parameters[0], parameters[0] + 2 * term_count());
    const MatrixXd columns = basis(rates);
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(columns);
    const VectorXd coefficients = qr.solve(target_);
    Eigen::Map<VectorXd>(residuals, size()) = columns * coefficients - target_;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<RowMajor> derivative(jacobians[0], size(), static_cast<Index>(rates.size()));
    for (Index r = 0; r < derivative.cols(); ++r) {
      const Index column = 3 * (r / 2) + 1 + r % 2;
      VectorXd rotated =
          qr.householderQ().adjoint() *
          (coefficients[column] * column_derivative(r, rates[static_cast<std::size_t>(r)])).eval();
      rotated.head(qr.rank()).setZero();
      derivative.col(r) = qr.householderQ() * rotated;
    }
    return true;
  }

  std::vector<SpecularTerm> terms(const std::vector<double>& rates) const {
    const VectorXd c = basis(rates).colPivHouseholderQr().solve(target_);
    std::vector<SpecularTerm> terms;
    for (std::size_t t = 0; t < form_.powers.size(); ++t) {
      const auto first = static_cast<Index>(3 * t);
      terms.push_back({form_.powers[t], AlphaCurve{c[first], c[first + 1], rates[2 * t], c[first + 2],
                                                   rates[2 * t + 1], 0.0}});
    }
    if (form_.pole) terms[slope_term()].factor.pole = c[c.size() - 1];
    return terms;
  }

 private:
  Index sample_count() const { return alpha_.size(); }
  Index column_count() const { return 3 * weights_.cols() + (form_.pole ? 1 : 0); }

  // Returns the derivative of the column that depends on rate `r`.
  VectorXd column_derivative(Index r, double rate) const {
    const Index count = sample_count();
    const auto argument = [&](double alpha) { return r % 2 == 1 ? alpha * alpha : alpha; };
    VectorXd change = VectorXd::Zero(size());
    for (Index i = 0; i < count; ++i)
      change[i] = weights_(i, r / 2) * rise_derivative(rate, argument(alpha_[i]));
    change[count + 3 * (r / 2) + 1 + r % 2] = penalty_ * rise_derivative(rate, argument(last_alpha_));
    return change;
  }

  const ParametricForm& form_;
  double first_alpha_, second_alpha_, last_alpha_;
  VectorXd alpha_;
  MatrixXd weights_;  // one column per term
  double penalty_ = 0.0;
  VectorXd target_;  // of the samples, and then 0 for the penalty of each column
};

struct Rates {
  std::vector<double> values;
  double cost = std::numeric_limits<double>::infinity();
};

bool cheaper(const Rates& a, const Rates& b) { return a.cost < b.cost; }

Rates polish(VariableProjection& projection, Rates rates) {
  const auto count = static_cast<int>(rates.values.size());
  for (std::size_t r = 0; r < rates.values.size(); ++r)
    rates.values[r] = std::min(rates.values[r], projection.largest_rate(r % 2 == 1));
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&projection, nullptr, rates.values.data());
  for (int r = 0; r < count; ++r) {
    problem.SetParameterLowerBound(rates.values.data(), r, 0.0);
    problem.SetParameterUpperBound(rates.values.data(), r, projection.largest_rate(r % 2 == 1));
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 500;
  // If an error decreases by less in one step, this is rounding.
  options.function_tolerance = 1e-7;
  options.parameter_tolerance = 1e-9;
  options.gradient_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable() || !std::isfinite(summary.final_cost)) return {};
  rates.cost = 2.0 * summary.final_cost;
  return rates;
}

// Searches rates on the grid, one term after another, beginning with the slope. The best few pairs of one
// term are combined with every pair of the next term.
std::vector<Rates> search_starts(const VariableProjection& projection) {
  std::vector<Rates> beams = {{std::vector<double>(2 * projection.term_count(), 0.0)}};
  std::vector<std::size_t> order = {projection.slope_term()};
  for (std::size_t term = 0; term < projection.term_count(); ++term)
    if (term != projection.slope_term()) order.push_back(term);
  for (const std::size_t term : order) {
    std::vector<Rates> tried;
    for (const Rates& beam : beams) {
      for (const double ramp_rate : kStartRates) {
        for (const double bump_rate : kStartRates) {
          if (ramp_rate > projection.largest_rate(false) || bump_rate > projection.largest_rate(true))
            continue;
          Rates rates = beam;
          rates.values[2 * term] = ramp_rate;
          rates.values[2 * term + 1] = bump_rate;
          rates.cost = projection.cost(rates.values);
          tried.push_back(std::move(rates));
        }
      }
    }
    std::stable_sort(tried.begin(), tried.end(), cheaper);
    tried.resize(std::min(tried.size(), kPolishedStarts));
    beams = std::move(tried);
  }
  return beams;
}

// Returns an infinite cost if no start converges.
Rates best_or_none(VariableProjection& projection, const std::vector<Rates>& starts) {
  Rates best;
  for (const Rates& start : starts) {
    const Rates candidate = polish(projection, start);
    if (candidate.cost < best.cost) best = candidate;
  }
  return best;
}

Rates best_of(VariableProjection& projection, const std::vector<Rates>& starts) {
  const Rates best = best_or_none(projection, starts);
  if (!std::isfinite(best.cost))
    throw numeric_error(
        "fit: the rates of k(alpha) did not converge from any start (check the table with remapc check)");
  return best;
}

void require_samples(std::size_t alpha_count, std::size_t specular_count, const ParametricForm& form) {
  if (alpha_count < kFewestAlphas)
    throw input_error("fit: the training rows have too few distinct alpha1 (" + std::to_string(alpha_count) +
                      ", at least " + std::to_string(kFewestAlphas) + " are required)");
  if (specular_count < form.powers.size())
    throw input_error("fit: the training rows have too few distinct specular1 (" +
                      std::to_string(specular_count) + ", the form " + std::string(form.specular) +
                      " requires at least " + std::to_string(form.powers.size()) + ")");
}

}  // namespace

std::vector<SpecularTerm> fit_specular_terms(const std::vector<TableRow>& rows, const ParametricForm& form,
                                             const std::vector<SpecularTerm>* near) {
  RowsByAlpha by_alpha, thinned;
  std::set<double> alphas, speculars;  // only rows whose specular is not negligible
  for (const TableRow& row : rows) {
    by_alpha[row.alpha1].push_back(&row);
    if (!(row.specular1 > 0.0)) continue;
    alphas.insert(row.alpha1);
    speculars.insert(row.specular1);
  }
  require_samples(alphas.size(), speculars.size(), form);
  const std::size_t step = (by_alpha.size() + kStartAlphas - 1) / kStartAlphas;
  std::size_t position = 0;
  for (const auto& group : by_alpha)
    if (position++ % step == 0) thinned.insert(group);

  VariableProjection projection(by_alpha, form);
  if (near != nullptr) {
    std::vector<Rates> starts(1);
    for (const SpecularTerm& term : *near)
      starts[0].values.insert(starts[0].values.end(), {term.factor.ramp_rate, term.factor.bump_rate});
    const Rates found = best_or_none(projection, starts);
    if (std::isfinite(found.cost)) return projection.terms(found.values);
  }
  VariableProjection few_projection(thinned, form);
  std::vector<Rates> starts = search_starts(few_projection);
  if (step > 1) starts = {best_of(few_projection, starts)};
  return projection.terms(best_of(projection, starts).values);
}

}  // namespace remap
