// The optimisers of network_training.hpp: one training from one set of initial parameters. The only part of
// the networks that touches Ceres.
#pragma once

#include <cstdint>
#include <functional>

#include "fit/network/network_batch.hpp"
#include "fit/network/network_samples.hpp"

namespace remapc {

struct OptimiserSettings {
  // The loss is the mean squared error of the normalised outputs plus weight_decay times the sum of the
  // squared weights (biases are free).
  double weight_decay = 0.0;
  int iterations = 300;    // at most
  int patience = 100;      // iterations without a better validation error before it stops
  int batch = 128;         // samples a step, of run_adam
  double step = 3e-3;      // largest step, of run_adam
  std::uint64_t seed = 1;  // order of the samples, of run_adam
};

struct OptimisedNetwork {
  Eigen::VectorXd parameters;   // those with the least validation error that was seen
  double validation_rms = 0.0;  // infinity where no finite error was seen
  int iterations = 0;
  int best_iteration = 0;
};

// Called after each iteration with the share that is done, 0 to 1. Must not throw; false stops the training.
using StepReport = std::function<bool(double share)>;

// Levenberg-Marquardt with the dense analytic Jacobian; for networks of up to some hundreds of parameters.
// Time for each iteration grows with samples times parameters squared.
OptimisedNetwork run_levenberg_marquardt(const NetworkShape& shape, const NetworkSamples& samples,
                                         const Eigen::VectorXd& start, const OptimiserSettings& settings,
                                         const StepReport& report);

// Adam (Kingma and Ba 2015) on mini-batches: the step rises over the first twentieth of the iterations and
// falls to 0 along a cosine. An iteration is a pass over the samples.
OptimisedNetwork run_adam(const NetworkShape& shape, const NetworkSamples& samples,
                          const Eigen::VectorXd& start, const OptimiserSettings& settings,
                          const StepReport& report);

// L-BFGS on all samples at once.
OptimisedNetwork run_lbfgs(const NetworkShape& shape, const NetworkSamples& samples,
                           const Eigen::VectorXd& start, const OptimiserSettings& settings,
                           const StepReport& report);

// Root mean square of the differences of normalised outputs.
double rms_difference(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected);

}  // namespace remapc
