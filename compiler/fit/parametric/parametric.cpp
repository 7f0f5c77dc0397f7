#include "fit/parametric/parametric.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <Eigen/Dense>
#include <ceres/ceres.h>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "lower/evaluate.hpp"

namespace remap {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kDegree = 4;       // of the polynomial
constexpr int kAlphaSteps = 1000;  // steps of the grid on which a curve is checked
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

// Returns the derivative of phi(rate, x) by the rate. Uses the series if the closed formula is 0 / 0.
double rise_derivative(double rate, double x) {
  const double y = rate * x;
  if (y < 1e-3) return -x * x * (1.0 / 2.0 - y * (1.0 / 3.0 - y * (1.0 / 8.0 - y / 30.0)));
  return (y * std::exp(-y) + std::expm1(-y)) / (rate * rate);
}

using Rates = std::array<double, 2>;  // ramp_rate and bump_rate of the curve

// VariableProjection gives the squared error as a function of the rates only. The other coefficients are the
// least squares solution for these rates (Golub and Pereyra 1973). The Jacobian is Kaufman's (1975), whose
// gradient is exact.
class VariableProjection : public ceres::CostFunction {
 public:
  // Combines the rows of each alpha, of which there are two or more. If k is the value of the curve at alpha,
  // |weight k - target|^2 is their squared error up to a constant. A QR decomposition of their speculars
  // makes this exact.
  VariableProjection(const RowsByAlpha& by_alpha, bool with_pole)
      : with_pole_(with_pole),
        first_alpha_(by_alpha.begin()->first),
        second_alpha_(std::next(by_alpha.begin())->first),
        last_alpha_(by_alpha.rbegin()->first) {
    alpha_.resize(static_cast<Index>(by_alpha.size()));
    weights_.resize(alpha_.size());
    target_ = VectorXd::Zero(size());
    Index next = 0;
    double row_count = 0.0;
    for (const auto& [alpha, rows] : by_alpha) {
      MatrixXd left(static_cast<Index>(rows.size()), 1);
      VectorXd right(left.rows());
      for (Index i = 0; i < right.size(); ++i) {
        left(i, 0) = rows[static_cast<std::size_t>(i)]->specular1;
        right[i] = rows[static_cast<std::size_t>(i)]->specular2;
      }
      if (left.rows() > 1) {
        const Eigen::HouseholderQR<MatrixXd> qr(left);
        right = qr.householderQ().adjoint() * right;
        left = qr.matrixQR().topRows(1).triangularView<Eigen::Upper>();
      }
      alpha_[next] = alpha;
      weights_[next] = left(0, 0);
      target_[next] = right[0];
      row_count += static_cast<double>(rows.size());
      ++next;
    }
    penalty_ = kContributionPenalty * std::sqrt(row_count);
    set_num_residuals(static_cast<int>(size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(Rates{}.size()));
  }

  double largest_rate(bool bump) const {
    const double alpha = second_alpha_;
    return kLargestDecay / (bump ? alpha * alpha : alpha);
  }

  double cost(const Rates& rates) const {
    const MatrixXd columns = basis(rates);
    const VectorXd coefficients = columns.colPivHouseholderQr().solve(target_);
    return (columns * coefficients - target_).squaredNorm();
  }

  // Computes the residuals and, if Ceres asks for it, their derivatives by each rate.
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Rates rates = {parameters[0][0], parameters[0][1]};
    const MatrixXd columns = basis(rates);
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(columns);
    const VectorXd coefficients = qr.solve(target_);
    Eigen::Map<VectorXd>(residuals, size()) = columns * coefficients - target_;
    if (jacobians == nullptr || jacobians[0] == nullptr) return true;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<RowMajor> derivative(jacobians[0], size(), static_cast<Index>(rates.size()));
    for (Index r = 0; r < derivative.cols(); ++r) {
      VectorXd rotated =
          qr.householderQ().adjoint() *
          (coefficients[1 + r] * column_derivative(r, rates[static_cast<std::size_t>(r)])).eval();
      rotated.head(qr.rank()).setZero();
      derivative.col(r) = qr.householderQ() * rotated;
    }
    return true;
  }

  AlphaCurve curve(const Rates& rates) const {
    const VectorXd c = basis(rates).colPivHouseholderQr().solve(target_);
    return {c[0], c[1], rates[0], c[2], rates[1], with_pole_ ? c[3] : 0.0};
  }

 private:
  Index column_count() const { return with_pole_ ? 4 : 3; }
  Index size() const { return alpha_.size() + column_count(); }

  // Returns one row for each alpha, and then one row for each column, for the penalty.
  MatrixXd basis(const Rates& rates) const {
    const Index count = alpha_.size();
    MatrixXd columns = MatrixXd::Zero(size(), column_count());
    for (Index i = 0; i < count; ++i) {
      const double alpha = alpha_[i], weight = weights_[i];
      columns(i, 0) = weight;
      columns(i, 1) = weight * rise(rates[0], alpha);
      columns(i, 2) = weight * rise(rates[1], alpha * alpha);
    }
    const double last = last_alpha_;
    columns(count, 0) = penalty_;
    columns(count + 1, 1) = penalty_ * rise(rates[0], last);
    columns(count + 2, 2) = penalty_ * rise(rates[1], last * last);
    if (with_pole_) {
      columns.col(3).head(count) = weights_.cwiseQuotient(alpha_);
      columns(count + 3, 3) = penalty_ / first_alpha_;
    }
    return columns;
  }

  // Returns the derivative of the column that depends on rate `r`.
  VectorXd column_derivative(Index r, double rate) const {
    const Index count = alpha_.size();
    const auto argument = [&](double alpha) { return r == 1 ? alpha * alpha : alpha; };
    VectorXd change = VectorXd::Zero(size());
    for (Index i = 0; i < count; ++i) change[i] = weights_[i] * rise_derivative(rate, argument(alpha_[i]));
    change[count + 1 + r] = penalty_ * rise_derivative(rate, argument(last_alpha_));
    return change;
  }

  bool with_pole_;
  double first_alpha_, second_alpha_, last_alpha_;
  VectorXd alpha_, weights_;
  double penalty_ = 0.0;
  VectorXd target_;  // of the alphas, and then 0 for the penalty of each column
};

struct Start {
  Rates rates{};
  double cost = std::numeric_limits<double>::infinity();
};

Start polish(VariableProjection& projection, Start start) {
  double* rates = start.rates.data();
  for (std::size_t r = 0; r < start.rates.size(); ++r)
    rates[r] = std::min(rates[r], projection.largest_rate(r == 1));
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&projection, nullptr, rates);
  for (int r = 0; r < 2; ++r) {
    problem.SetParameterLowerBound(rates, r, 0.0);
    problem.SetParameterUpperBound(rates, r, projection.largest_rate(r == 1));
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
  start.cost = 2.0 * summary.final_cost;
  return start;
}

// Returns the best few pairs of rates on the grid.
std::vector<Start> search_starts(const VariableProjection& projection) {
  std::vector<Start> tried;
  for (const double ramp_rate : kStartRates)
    for (const double bump_rate : kStartRates)
      if (ramp_rate <= projection.largest_rate(false) && bump_rate <= projection.largest_rate(true))
        tried.push_back({{ramp_rate, bump_rate}, projection.cost({ramp_rate, bump_rate})});
  std::ranges::stable_sort(tried, {}, &Start::cost);
  tried.resize(std::min(tried.size(), kPolishedStarts));
  return tried;
}

Start best_of(VariableProjection& projection, const std::vector<Start>& starts) {
  Start best;
  for (const Start& start : starts) {
    const Start candidate = polish(projection, start);
    if (candidate.cost < best.cost) best = candidate;
  }
  if (!std::isfinite(best.cost))
    throw numeric_error(
        "fit: the rates of k(alpha) did not converge from any start (check the table with remapc check)");
  return best;
}

// Returns the curve k with the least squared error in specular2 over the rows, by variable projection. Ceres
// searches the rates from a grid of starts, and least squares gives the linear coefficients for them.
AlphaCurve fit_slope(const std::vector<TableRow>& rows, bool with_pole) {
  RowsByAlpha by_alpha, thinned;
  std::set<double> alphas;  // only rows whose specular is not negligible
  for (const TableRow& row : rows) {
    by_alpha[row.alpha1].push_back(&row);
    if (row.specular1 > 0.0) alphas.insert(row.alpha1);
  }
  if (alphas.size() < kFewestAlphas)
    throw input_error("fit: the training rows have too few distinct alpha1 (" +
                      std::to_string(alphas.size()) + ", at least " + std::to_string(kFewestAlphas) +
                      " are required)");
  const std::size_t step = (by_alpha.size() + kStartAlphas - 1) / kStartAlphas;
  std::size_t position = 0;
  for (const auto& group : by_alpha)
    if (position++ % step == 0) thinned.insert(group);

  VariableProjection projection(by_alpha, with_pole), few_projection(thinned, with_pole);
  std::vector<Start> starts = search_starts(few_projection);
  if (step > 1) starts = {best_of(few_projection, starts)};
  return projection.curve(best_of(projection, starts).rates);
}

// Returns the least squares coefficients of the polynomial for alpha2.
std::vector<double> fit_roughness(const std::vector<TableRow>& rows) {
  MatrixXd basis(static_cast<Index>(rows.size()), kDegree);
  VectorXd target(basis.rows());
  for (Index r = 0; r < basis.rows(); ++r) {
    const TableRow& row = rows[static_cast<std::size_t>(r)];
    double power = 1.0;
    for (Index i = 0; i < kDegree; ++i) basis(r, i) = power *= row.alpha1;
    target(r) = row.alpha2;
  }
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(basis);
  if (qr.rank() < kDegree)
    throw input_error("fit: the training rows have too few distinct samples for the form quartic (at least " +
                      std::to_string(kDegree) + " that differ in alpha1 and specular1 are required)");
  const VectorXd solution = qr.solve(target);
  return {solution.begin(), solution.end()};
}

// Returns where `quantity` is smallest on a grid, or where it is NaN.
double least_place(const Range& alphas, const auto& quantity) {
  double place = 0.0, least = 1e300;
  for (int i = 0; i <= kAlphaSteps; ++i) {
    const double alpha =
        i == kAlphaSteps ? alphas.max : alphas.min + (alphas.max - alphas.min) * i / kAlphaSteps;
    const double value = quantity(alpha);
    if (!(value < least || std::isnan(value))) continue;
    least = value;
    place = alpha;
  }
  return place;
}

// Throws kNumeric with `fault` and the place, if `quantity` is not positive everywhere.
void require_positive(const Range& alphas, const std::string& fault, const auto& quantity) {
  const double place = least_place(alphas, quantity), least = quantity(place);
  if (!(least > 0.0)) throw numeric_error(fault + number_text(least) + " at alpha1 " + number_text(place));
}

}  // namespace

bool has_pole(const std::string& form) {
  if (form == "paper+pole") return true;
  if (form.empty() || form == "paper") return false;
  throw usage_error("--form: unknown form '" + form + "' (choose paper or paper+pole)");
}

Regression fit_parametric(const std::vector<TableRow>& rows, const Domain& domain, const std::string& form) {
  const AlphaCurve slope = fit_slope(rows, has_pole(form));
  const std::vector<double> polynomial = fit_roughness(rows);
  require_positive(domain.alpha,
                   "fit: the roughness curve does not increase from " + number_text(domain.alpha.min) +
                       " to " + number_text(domain.alpha.max) + ": its slope is ",
                   [&](double alpha) {
                     double derivative = 0.0;
                     for (std::size_t i = polynomial.size(); i-- > 0;)
                       derivative = derivative * alpha + static_cast<double>(i + 1) * polynomial[i];
                     return derivative;
                   });
  require_positive(domain.alpha, "fit: k(alpha) is not positive: it is ",
                   [&](double alpha) { return curve_value(slope, alpha); });
  return {Parametric{{polynomial}, {{1, slope}}}, {{"form", form.empty() ? "paper" : form}}};
}

}  // namespace remap
