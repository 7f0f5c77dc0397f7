#include "fit/network/network_optimisers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include <ceres/ceres.h>

#include "measure/function_cost.hpp"

namespace remap {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// Returns the derivative of the activation at x, where its value is y.
double activation_slope(Activation activation, double x, double y) {
  switch (activation) {
    case Activation::kRelu:
      return x > 0.0 ? 1.0 : 0.0;
    case Activation::kTanh:
      return 1.0 - y * y;
    case Activation::kSilu: {  // with s = 1 / (1 + exp(-x)): s + x s (1 - s) = s + y (1 - s)
      const double s = 0.5 * std::tanh(0.5 * x) + 0.5;
      return s + y * (1.0 - s);
    }
  }
  return 1.0;
}

// Returns the place of each layer in a parameter vector, then the length of the vector.
std::vector<std::size_t> layer_offsets(const NetworkShape& shape) {
  std::vector<std::size_t> offsets = {0};
  for (std::size_t l = 0; l + 1 < shape.sizes.size(); ++l)
    offsets.push_back(offsets.back() + (shape.sizes[l] + 1) * shape.sizes[l + 1]);
  return offsets;
}

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A ValidationWatch looks at the parameters after each iteration of a training. It keeps those with the least
// validation error. It ends the training if this error no longer improves, or if the caller wants to stop.
class ValidationWatch : public ceres::IterationCallback {
 public:
  ValidationWatch(const NetworkShape& shape, const NetworkSamples& samples, const VectorXd& parameters,
                  const OptimiserSettings& settings, const StepReport& report)
      : batch_(shape, samples.validation_inputs),
        expected_(samples.validation_outputs),
        parameters_(parameters),
        settings_(settings),
        report_(report) {
    best_.validation_rms = std::numeric_limits<double>::infinity();
  }

  // Returns false after too many iterations without an improvement.
  bool observe(int iteration) {
    const double rms = rms_difference(batch_.forward(parameters_.data()), expected_);
    best_.iterations = iteration;
    if (rms < best_.validation_rms) {
      best_.validation_rms = rms;
      best_.parameters = parameters_;
      best_.best_iteration = iteration;
    }
    return iteration - best_.best_iteration < settings_.patience;
  }

  bool report(int iteration) const { return report_(static_cast<double>(iteration) / settings_.iterations); }

  // Ceres calls this after each iteration.
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    const bool improves = observe(summary.iteration), continues = report(summary.iteration);
    return improves && continues ? ceres::SOLVER_CONTINUE : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

  const OptimisedNetwork& best() const noexcept { return best_; }

 private:
  NetworkBatch batch_;
  const MatrixXd& expected_;
  const VectorXd& parameters_;
  const OptimiserSettings& settings_;
  const StepReport& report_;
  OptimisedNetwork best_;
};

// NetworkLoss gives the loss as one number, with its gradient.
class NetworkLoss : public ceres::FirstOrderFunction {
 public:
  NetworkLoss(const NetworkShape& shape, const NetworkSamples& samples, double weight_decay)
      : batch_(shape, samples.training_inputs),
        expected_(samples.training_outputs),
        decay_(weight_decay * weight_mask(shape)) {}

  int NumParameters() const override { return static_cast<int>(decay_.size()); }

  bool Evaluate(const double* parameters, double* cost, double* gradient) const override {
    const Eigen::Map<const VectorXd> values(parameters, decay_.size());
    const MatrixXd differences = batch_.forward(parameters) - expected_;
    const auto count = static_cast<double>(expected_.size());
    *cost = differences.squaredNorm() / count + values.dot(decay_.cwiseProduct(values));
    if (gradient != nullptr) {
      batch_.gradient(parameters, differences * (2.0 / count), gradient);
      Eigen::Map<VectorXd>(gradient, decay_.size()) += 2.0 * decay_.cwiseProduct(values);
    }
    return std::isfinite(*cost);
  }

 private:
  mutable NetworkBatch batch_;
  const MatrixXd& expected_;
  VectorXd decay_;
};

// The tolerances only end searches that no longer move. Otherwise, the validation error decides when to stop.
template <typename Options>
void set_limits(Options& options, const OptimiserSettings& settings, ceres::IterationCallback& callback) {
  options.max_num_iterations = settings.iterations;
  options.function_tolerance = 1e-9;
  options.parameter_tolerance = 1e-12;
  options.gradient_tolerance = 1e-16;
  options.logging_type = ceres::SILENT;
  options.update_state_every_iteration = true;
  options.callbacks.push_back(&callback);
}

}  // namespace

std::size_t NetworkShape::parameter_count() const { return layer_offsets(*this).back(); }

std::vector<Layer> layers_from_parameters(const NetworkShape& shape, const double* parameters) {
  std::vector<Layer> layers;
  for (std::size_t l = 0; l + 1 < shape.sizes.size(); ++l) {
    const std::size_t weight_count = shape.sizes[l] * shape.sizes[l + 1];
    Layer layer;
    layer.input_count = shape.sizes[l];
    layer.weights.assign(parameters, parameters + weight_count);
    parameters += weight_count;
    layer.biases.assign(parameters, parameters + shape.sizes[l + 1]);
    parameters += shape.sizes[l + 1];
    layers.push_back(std::move(layer));
  }
  return layers;
}

Eigen::VectorXd weight_mask(const NetworkShape& shape) {
  Eigen::VectorXd mask = Eigen::VectorXd::Ones(static_cast<Index>(shape.parameter_count()));
  const std::vector<std::size_t> offsets = layer_offsets(shape);
  for (std::size_t l = 0; l + 1 < shape.sizes.size(); ++l) {
    const auto biases = static_cast<Index>(shape.sizes[l + 1]);
    mask.segment(static_cast<Index>(offsets[l + 1]) - biases, biases).setZero();
  }
  return mask;
}

NetworkBatch::NetworkBatch(NetworkShape shape, MatrixXd inputs)
    : shape_(std::move(shape)),
      offsets_(layer_offsets(shape_)),
      values_(shape_.sizes.size()),
      slopes_(shape_.sizes.size()) {
  values_.front() = std::move(inputs);
}

void NetworkBatch::set_inputs(MatrixXd inputs) { values_.front() = std::move(inputs); }

Eigen::Map<const NetworkBatch::RowMajor> NetworkBatch::weights(const double* parameters,
                                                               std::size_t layer) const {
  return {parameters + offsets_[layer], size(layer + 1), size(layer)};
}

const MatrixXd& NetworkBatch::forward(const double* parameters) {
  const std::size_t last = shape_.sizes.size() - 1;
  for (std::size_t l = 0; l < last; ++l) {
    MatrixXd& sums = values_[l + 1];
    const Eigen::Map<const Eigen::VectorXd> biases(
        parameters + offsets_[l] + shape_.sizes[l] * shape_.sizes[l + 1], size(l + 1));
    sums.noalias() = weights(parameters, l) * values_[l];
    sums.colwise() += biases;
    if (l + 1 == last) break;
    MatrixXd& slopes = slopes_[l + 1];
    slopes.resize(sums.rows(), sums.cols());
    for (Index i = 0; i < sums.size(); ++i) {
      const double x = sums.data()[i];
      const double y = activated(shape_.activation, x);
      sums.data()[i] = y;
      slopes.data()[i] = activation_slope(shape_.activation, x, y);
    }
  }
  return values_.back();
}

MatrixXd NetworkBatch::before(const double* parameters, std::size_t layer, const MatrixXd& behind) const {
  return (weights(parameters, layer).transpose() * behind).cwiseProduct(slopes_[layer]);
}

void NetworkBatch::jacobian(const double* parameters, Eigen::Ref<RowMajor> jacobian) const {
  const std::size_t last = shape_.sizes.size() - 1;
  const Index output_count = size(last);
  for (Index k = 0; k < output_count; ++k) {
    MatrixXd deltas = MatrixXd::Zero(output_count, sample_count());
    deltas.row(k).setOnes();
    for (std::size_t l = last; l-- > 0;) {
      const MatrixXd& values = values_[l];
      const Index weight_count = values.rows() * deltas.rows();
      for (Index n = 0; n < sample_count(); ++n) {
        double* row = &jacobian(n * output_count + k, static_cast<Index>(offsets_[l]));
        for (Index i = 0; i < deltas.rows(); ++i)
          for (Index j = 0; j < values.rows(); ++j) row[i * values.rows() + j] = deltas(i, n) * values(j, n);
        for (Index i = 0; i < deltas.rows(); ++i) row[weight_count + i] = deltas(i, n);
      }
      if (l > 0) deltas = before(parameters, l, deltas);
    }
  }
}

void NetworkBatch::gradient(const double* parameters, const MatrixXd& by_outputs, double* gradient) const {
  MatrixXd deltas = by_outputs;
  for (std::size_t l = shape_.sizes.size() - 1; l-- > 0;) {
    Eigen::Map<RowMajor> by_weights(gradient + offsets_[l], size(l + 1), size(l));
    by_weights.noalias() = deltas * values_[l].transpose();
    Eigen::Map<Eigen::VectorXd>(gradient + offsets_[l] + shape_.sizes[l] * shape_.sizes[l + 1], size(l + 1)) =
        deltas.rowwise().sum();
    if (l > 0) deltas = before(parameters, l, deltas);
  }
}

double rms_difference(const MatrixXd& found, const MatrixXd& expected) {
  return std::sqrt((found - expected).squaredNorm() / static_cast<double>(expected.size()));
}

OptimisedNetwork run_levenberg_marquardt(const NetworkShape& shape, const NetworkSamples& samples,
                                         const VectorXd& start, const OptimiserSettings& settings,
                                         const StepReport& report) {
  VectorXd parameters = start;
  NetworkBatch batch(shape, samples.training_inputs);  // Ceres uses one thread here
  const MatrixXd& expected = samples.training_outputs;
  const Index count = expected.size(), unknowns = start.size();
  // The decay is scaled, because Ceres minimizes half the sum of squares, and the loss is the mean of
  // squares.
  const VectorXd decay = std::sqrt(settings.weight_decay * static_cast<double>(count)) * weight_mask(shape);
  // There is a residual for each output and, with decay, for each weight.
  const Index residual_count = count + (settings.weight_decay > 0.0 ? unknowns : 0);
  const auto evaluate = [&](const double* at, double* residuals, double* derivatives) {
    const Eigen::Map<const VectorXd> values(at, unknowns);
    Eigen::Map<MatrixXd>(residuals, expected.rows(), expected.cols()) = batch.forward(at) - expected;
    const Index decays = residual_count - count;
    if (decays > 0) Eigen::Map<VectorXd>(residuals + count, decays) = decay.cwiseProduct(values);
    if (derivatives == nullptr) return true;
    Eigen::Map<NetworkBatch::RowMajor> jacobian(derivatives, residual_count, unknowns);
    batch.jacobian(at, jacobian.topRows(count));
    jacobian.bottomRows(decays).setZero();
    if (decays > 0) jacobian.bottomRows(decays).diagonal() = decay;
    return true;
  };
  ceres::Problem problem;
  problem.AddResidualBlock(new FunctionCost(static_cast<std::size_t>(residual_count),
                                            static_cast<std::size_t>(unknowns), evaluate),
                           nullptr, parameters.data());
  ValidationWatch watch(shape, samples, parameters, settings, report);
  ceres::Solver::Options options;
  set_limits(options, settings, watch);
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return watch.best();
}

OptimisedNetwork run_lbfgs(const NetworkShape& shape, const NetworkSamples& samples, const VectorXd& start,
                           const OptimiserSettings& settings, const StepReport& report) {
  VectorXd parameters = start;
  const ceres::GradientProblem problem(new NetworkLoss(shape, samples, settings.weight_decay));
  ValidationWatch watch(shape, samples, parameters, settings, report);
  ceres::GradientProblemSolver::Options options;
  set_limits(options, settings, watch);
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(options, problem, parameters.data(), &summary);
  return watch.best();
}

OptimisedNetwork run_adam(const NetworkShape& shape, const NetworkSamples& samples, const VectorXd& start,
                          const OptimiserSettings& settings, const StepReport& report) {
  constexpr double kFirst = 0.9, kSecond = 0.999, kFloor = 1e-8;  // as in the paper
  constexpr Index kBatch = 128;                                   // samples per step
  constexpr double kLargestStep = 3e-3;
  const VectorXd decay = settings.weight_decay * weight_mask(shape);
  const Index count = samples.training_inputs.cols();
  const Index batch_size = std::min(kBatch, count);
  const Index batches = (count + batch_size - 1) / batch_size;
  const double steps = static_cast<double>(batches) * settings.iterations;
  std::vector<Index> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), Index{0});
  std::mt19937_64 random(settings.seed);

  NetworkBatch batch(shape, {});
  VectorXd parameters = start, gradient(start.size());
  ValidationWatch watch(shape, samples, parameters, settings, report);
  VectorXd first = VectorXd::Zero(start.size()), second = VectorXd::Zero(start.size());
  watch.observe(0);
  double step = 0.0;
  for (int pass = 1; pass <= settings.iterations; ++pass) {
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    for (Index b = 0; b < count; b += batch_size) {
      const std::vector<Index> columns(order.begin() + b, order.begin() + std::min(count, b + batch_size));
      batch.set_inputs(samples.training_inputs(Eigen::all, columns));
      const MatrixXd differences =
          batch.forward(parameters.data()) - samples.training_outputs(Eigen::all, columns);
      batch.gradient(parameters.data(), differences * (2.0 / static_cast<double>(differences.size())),
                     gradient.data());
      gradient += 2.0 * decay.cwiseProduct(parameters);
      step += 1.0;
      const double done = step / steps;
      const double rate =
          kLargestStep * std::min(1.0, done * 20.0) * (0.5 + 0.5 * std::cos(std::numbers::pi * done));
      first = kFirst * first + (1.0 - kFirst) * gradient;
      second = kSecond * second + (1.0 - kSecond) * gradient.cwiseAbs2();
      const double first_share = 1.0 - std::pow(kFirst, step), second_share = 1.0 - std::pow(kSecond, step);
      parameters.array() -=
          rate * (first.array() / first_share) / ((second.array() / second_share).sqrt() + kFloor);
    }
    if (!watch.observe(pass) || !watch.report(pass)) break;
  }
  return watch.best();
}

}  // namespace remap
