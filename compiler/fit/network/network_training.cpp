#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <functional>
#include <limits>
#include <mutex>
#include <numeric>
#include <random>

#include "core/errors.hpp"
#include "core/number_text.hpp"
#include "core/parallel.hpp"
#include "fit/network/fit_network.hpp"
#include "fit/network/network_optimisers.hpp"
#include "table/regression.hpp"

namespace remap {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kFewestRows = 10;
constexpr std::size_t kLevenbergParameters = 600;
// Limits an iteration of Levenberg-Marquardt to about 0.05 s. Its time is proportional to residuals times
// parameters squared. In small networks, the Jacobian takes most of the time, which is proportional to the
// residuals.
constexpr double kLevenbergWork = 1e8;
constexpr double kFewestResiduals = 1500.0, kMostResiduals = 3000.0;
constexpr int kLevenbergIterations = 300;
constexpr int kLevenbergPatience = 80;
constexpr int kRefitIterations = 60;
constexpr double kStartsShare = 0.95;  // part of the progress bar; the refit gets the rest
// The number of passes of Adam is chosen so that this many multiplications are needed, within bounds.
constexpr double kAdamWork = 1e10;
constexpr double kFewestPasses = 10.0, kMostPasses = 400.0;
constexpr int kLbfgsIterations = 300;
constexpr int kLbfgsPatience = 50;
constexpr std::size_t kMostLbfgsRows = 4096;
constexpr std::size_t kMostValidationRows = 2048;

void require_sound(const Samples& samples, const TrainingOptions& options) {
  const std::size_t count = samples.count();
  if (samples.input_count == 0 || samples.output_count == 0 ||
      samples.inputs.size() % samples.input_count != 0 ||
      samples.outputs.size() != count * samples.output_count)
    throw input_error("network: " + std::to_string(samples.inputs.size()) + " inputs and " +
                      std::to_string(samples.outputs.size()) +
                      " outputs do not form equally many whole rows");
  if (count < kFewestRows)
    throw input_error("network: too few rows (" + std::to_string(count) + ", at least " +
                      std::to_string(kFewestRows) + " are required)");
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!std::ranges::all_of(samples.inputs, finite) || !std::ranges::all_of(samples.outputs, finite))
    throw input_error("network: a row contains a number that is not finite");
  if (std::ranges::find(options.hidden, std::size_t{0}) != options.hidden.end())
    throw usage_error("network: every hidden layer must have at least 1 unit");
  if (options.starts == 0) throw usage_error("network: at least 1 start is required");
  if (!(options.validation_fraction >= 0.0 && options.validation_fraction <= 0.5))
    throw usage_error("network: validation share " + number_text(options.validation_fraction) +
                      " is out of range (0 to 0.5)");
  if (!(options.weight_decay >= 0.0 && std::isfinite(options.weight_decay)))
    throw usage_error("network: weight decay " + number_text(options.weight_decay) +
                      " must be finite and at least 0");
}

// Returns a matrix with one column per sample.
Eigen::Map<const MatrixXd> columns_of(const std::vector<double>& values, std::size_t width) {
  return {values.data(), static_cast<Index>(width), static_cast<Index>(values.size() / width)};
}

// Scales values to [-1, 1].
Scaling range_scaling(const VectorXd& values) {
  const double low = values.minCoeff(), high = values.maxCoeff();
  if (!(high > low)) return {low, 1.0};
  return {low + 0.5 * (high - low), 2.0 / (high - low)};
}

// Scales values to mean 0 and variance 1.
Scaling variance_scaling(const VectorXd& values) {
  if (!(values.maxCoeff() > values.minCoeff())) return {values[0], 1.0};
  const double mean = values.mean();
  const double deviation = std::sqrt((values.array() - mean).square().mean());
  if (!(deviation > 0.0)) return {mean, 1.0};
  return {mean, 1.0 / deviation};
}

MatrixXd normalised_columns(const Eigen::Map<const MatrixXd>& values, const std::vector<Scaling>& scalings) {
  MatrixXd result = values;
  for (Index i = 0; i < result.rows(); ++i) {
    const Scaling& scaling = scalings[static_cast<std::size_t>(i)];
    result.row(i) = (result.row(i).array() - scaling.offset) * scaling.scale;
  }
  return result;
}

// Returns a seed for one purpose, which has the number `stream` (splitmix64, Steele et al. 2014).
std::uint64_t mixed_seed(std::uint64_t seed, std::uint64_t stream) {
  std::uint64_t z = seed + (stream + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

// Returns all samples as training samples, in random order. Stores the scalings of the network.
NetworkSamples normalised_samples(const Samples& samples, std::uint64_t seed, Network* network) {
  const auto inputs = columns_of(samples.inputs, samples.input_count);
  const auto outputs = columns_of(samples.outputs, samples.output_count);
  for (Index i = 0; i < inputs.rows(); ++i) network->inputs.push_back(range_scaling(inputs.row(i)));
  for (Index i = 0; i < outputs.rows(); ++i) network->outputs.push_back(variance_scaling(outputs.row(i)));
  const std::vector<std::size_t> order = seeded_order(samples.count(), mixed_seed(seed, 0));
  return {normalised_columns(inputs, network->inputs)(Eigen::all, order),
          normalised_columns(outputs, network->outputs)(Eigen::all, order),
          {},
          {}};
}

// Splits the samples. The first `validation_fraction` of them (1 to 2048) are validation samples. The
// following samples (at most `most_training`) are training samples. If the fraction is 0, the training
// samples are also the validation samples.
NetworkSamples split_columns(const NetworkSamples& all, double validation_fraction,
                             std::size_t most_training) {
  const MatrixXd &inputs = all.training_inputs, &outputs = all.training_outputs;
  const auto count = static_cast<std::size_t>(inputs.cols());
  auto validation = static_cast<std::size_t>(std::lround(validation_fraction * static_cast<double>(count)));
  if (validation_fraction > 0.0) validation = std::clamp(validation, std::size_t{1}, kMostValidationRows);
  const auto from = static_cast<Index>(validation);
  const auto training = static_cast<Index>(std::min(count - validation, most_training));
  NetworkSamples samples{inputs.middleCols(from, training), outputs.middleCols(from, training),
                         inputs.leftCols(from), outputs.leftCols(from)};
  if (validation == 0) {
    samples.validation_inputs = samples.training_inputs;
    samples.validation_outputs = samples.training_outputs;
  }
  return samples;
}

NetworkShape shape_of(const Samples& samples, const TrainingOptions& options) {
  NetworkShape shape{options.activation, {samples.input_count}};
  shape.sizes.insert(shape.sizes.end(), options.hidden.begin(), options.hidden.end());
  shape.sizes.push_back(samples.output_count);
  return shape;
}

// Returns uniform weights after Glorot and Bengio (2010) for tanh and after He et al. (2015) for other
// activations. Hidden biases are uniform in [-1, 1], so that units bend at different positions.
VectorXd initial_parameters(const NetworkShape& shape, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&random] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1.0; };
  VectorXd parameters(static_cast<Index>(shape.parameter_count()));
  Index next = 0;
  for (std::size_t l = 0; l + 1 < shape.sizes.size(); ++l) {
    const auto inputs = static_cast<double>(shape.sizes[l]),
               outputs = static_cast<double>(shape.sizes[l + 1]);
    const bool is_last = l + 2 == shape.sizes.size();
    const double reach = std::sqrt(6.0 / (shape.activation == Activation::kTanh ? inputs + outputs : inputs));
    for (std::size_t i = 0; i < shape.sizes[l] * shape.sizes[l + 1]; ++i)
      parameters[next++] = reach * uniform();
    for (std::size_t i = 0; i < shape.sizes[l + 1]; ++i) parameters[next++] = is_last ? 0.0 : uniform();
  }
  return parameters;
}

// A StartsProgress combines the progress of all starts into a fraction that never decreases. Exceptions must
// not pass through Ceres. So an exception is stored, it ends every start, and it is thrown again after all
// have ended.
class StartsProgress {
 public:
  StartsProgress(std::size_t starts, const FitProgress& progress)
      : shares_(starts, 0.0), progress_(progress) {}

  // Returns false if the training must end.
  bool report(std::size_t start, double share) noexcept {
    if (stopped_) return false;
    const std::lock_guard lock(mutex_);
    try {
      shares_[start] = std::max(shares_[start], std::min(1.0, share));
      const double sum = std::accumulate(shares_.begin(), shares_.end(), 0.0);
      if (progress_ && !stopped_) progress_(kStartsShare * sum / static_cast<double>(shares_.size()));
    } catch (...) {
      exception_ = std::current_exception();
      stopped_ = true;
    }
    return !stopped_;
  }

  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  std::mutex mutex_;
  std::vector<double> shares_;
  const FitProgress& progress_;
  std::exception_ptr exception_;
  std::atomic<bool> stopped_ = false;  // read without the lock
};

// A Training trains a network once. The seed determines the initial weights.
using Training = std::function<OptimisedNetwork(std::uint64_t seed, const StepReport& report)>;

// Trains from every start, returns the best network and adds the starts to the method.
OptimisedNetwork run_starts(const Training& train, const TrainingOptions& options,
                            const FitProgress& progress, TrainedNetwork* trained) {
  std::vector<OptimisedNetwork> results(options.starts);
  StartsProgress board(options.starts, progress);
  run_parallel(options.starts, options.jobs, [&](std::size_t start) {
    const auto report = [&board, start](double share) { return board.report(start, share); };
    if (!report(0.0)) return;
    results[start] = train(mixed_seed(options.seed, start + 1), report);
    report(1.0);
  });
  board.rethrow();
  const auto best = std::ranges::min_element(results, {}, &OptimisedNetwork::validation_rms);
  if (!std::isfinite(best->validation_rms))
    throw numeric_error("network: none of " + std::to_string(results.size()) + " starts gave finite errors");
  trained->best_start = static_cast<std::size_t>(best - results.begin());
  trained->method += std::to_string(options.starts) + " starts from seed " + std::to_string(options.seed) +
                     ", best " + std::to_string(trained->best_start + 1) + " at iteration " +
                     std::to_string(best->best_iteration) + " of " + std::to_string(best->iterations);
  return *best;
}

std::string shape_text(const NetworkShape& shape) {
  std::string text;
  for (const std::size_t size : shape.sizes) text += (text.empty() ? "" : "-") + std::to_string(size);
  return text + " " + std::string(activation_name(shape.activation));
}

// Both ways of training set `samples` to those that they use, and describe themselves in `trained`.
OptimisedNetwork train_small(const NetworkShape& shape, const NetworkSamples& all,
                             const TrainingOptions& options, const FitProgress& progress,
                             NetworkSamples* samples, TrainedNetwork* trained) {
  const auto parameters = static_cast<double>(shape.parameter_count());
  const double residuals =
      std::clamp(kLevenbergWork / (parameters * parameters), kFewestResiduals, kMostResiduals);
  const auto most = static_cast<std::size_t>(residuals / static_cast<double>(shape.sizes.back())) + 1;
  *samples = split_columns(all, options.validation_fraction, most);
  OptimiserSettings settings;
  settings.weight_decay = options.weight_decay;
  settings.iterations = kLevenbergIterations;
  settings.patience = kLevenbergPatience;
  trained->method = "Levenberg-Marquardt, ";
  OptimisedNetwork best = run_starts(
      [&](std::uint64_t seed, const StepReport& report) {
        return run_levenberg_marquardt(shape, *samples, initial_parameters(shape, seed), settings, report);
      },
      options, progress, trained);
  if (options.validation_fraction == 0.0) return best;

  // A short refit starts from the validated parameters, stays close to them, and uses the additional rows.
  const Index used = samples->training_inputs.cols() + samples->validation_inputs.cols();
  samples->training_inputs = all.training_inputs.leftCols(used);
  samples->training_outputs = all.training_outputs.leftCols(used);
  const NetworkSamples everything{samples->training_inputs, samples->training_outputs,
                                  samples->training_inputs, samples->training_outputs};
  settings.iterations = std::clamp(best.best_iteration / 2, 5, kRefitIterations);
  settings.patience = settings.iterations;
  const OptimisedNetwork refitted =
      run_levenberg_marquardt(shape, everything, best.parameters, settings, [](double) { return true; });
  if (std::isfinite(refitted.validation_rms)) best.parameters = refitted.parameters;
  trained->method +=
      ", then " + std::to_string(refitted.best_iteration) + " iterations with the validation rows";
  return best;
}

OptimisedNetwork train_large(const NetworkShape& shape, const NetworkSamples& all,
                             const TrainingOptions& options, const FitProgress& progress,
                             NetworkSamples* samples, TrainedNetwork* trained) {
  *samples = split_columns(all, options.validation_fraction, std::numeric_limits<std::size_t>::max());
  const NetworkSamples part = split_columns(all, options.validation_fraction, kMostLbfgsRows);
  // A pass takes about three multiplications per parameter and sample.
  const double pass_work = 3.0 * static_cast<double>(shape.parameter_count()) *
                           static_cast<double>(samples->training_inputs.cols());
  OptimiserSettings adam;
  adam.weight_decay = options.weight_decay;
  adam.iterations = static_cast<int>(std::clamp(kAdamWork / pass_work, kFewestPasses, kMostPasses));
  adam.patience = adam.iterations;
  OptimiserSettings lbfgs = adam;
  lbfgs.iterations = kLbfgsIterations;
  lbfgs.patience = kLbfgsPatience;
  trained->method = "Adam for " + std::to_string(adam.iterations) + " passes, then L-BFGS on " +
                    std::to_string(part.training_inputs.cols()) + " rows, ";
  return run_starts(
      [&](std::uint64_t seed, const StepReport& report) {
        OptimiserSettings own = adam;
        own.seed = mixed_seed(seed, 0);
        OptimisedNetwork first = run_adam(shape, *samples, initial_parameters(shape, seed), own,
                                          [&](double share) { return report(0.5 * share); });
        if (!std::isfinite(first.validation_rms)) return first;
        OptimisedNetwork second = run_lbfgs(shape, part, first.parameters, lbfgs,
                                            [&](double share) { return report(0.5 + 0.5 * share); });
        second.best_iteration += first.iterations;
        second.iterations += first.iterations;
        return second;
      },
      options, progress, trained);
}

}  // namespace

TrainedNetwork train_network(const Samples& samples, const TrainingOptions& options,
                             const FitProgress& progress) {
  require_sound(samples, options);
  const NetworkShape shape = shape_of(samples, options);
  TrainedNetwork trained;
  trained.network.activation = shape.activation;
  const NetworkSamples all = normalised_samples(samples, options.seed, &trained.network);
  const bool is_small = shape.parameter_count() <= kLevenbergParameters;
  NetworkSamples used;
  const OptimisedNetwork best =
      (is_small ? train_small : train_large)(shape, all, options, progress, &used, &trained);
  const double* parameters = best.parameters.data();
  trained.network.layers = layers_from_parameters(shape, parameters);
  NetworkBatch batch(shape, used.training_inputs);
  trained.training_rms = rms_difference(batch.forward(parameters), used.training_outputs);
  trained.validation_rms = best.validation_rms;
  const bool shares_rows =
      options.validation_fraction == 0.0 || is_small;  // the training rows include the validation rows
  trained.rows = static_cast<std::size_t>(used.training_inputs.cols() +
                                          (shares_rows ? 0 : used.validation_inputs.cols()));
  trained.method = shape_text(shape) + ", " + trained.method + ", " + std::to_string(trained.rows) + " of " +
                   std::to_string(samples.count()) + " rows";
  if (progress) progress(1.0);
  return trained;
}

}  // namespace remap
