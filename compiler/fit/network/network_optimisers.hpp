// This file declares the optimisers of network_training.hpp. Each function runs one training from one set of
// initial parameters. Among the files about networks, only network_optimisers.cpp uses Ceres.
#pragma once

#include <cstdint>
#include <functional>

#include "fit/network/network_batch.hpp"

namespace remap {

// A NetworkSamples holds normalised samples, one column each. Validation samples stop the training.
struct NetworkSamples {
  Eigen::MatrixXd training_inputs, training_outputs;
  Eigen::MatrixXd validation_inputs, validation_outputs;
};

struct OptimiserSettings {
  // The loss is the mean squared error of the normalised outputs plus weight_decay times the sum of the
  // squared weights, without biases.
  double weight_decay = 0.0;
  int iterations = 300;    // maximum
  int patience = 100;      // stops after so many iterations without a better validation error
  int batch = 128;         // samples per step of run_adam
  double step = 3e-3;      // largest step of run_adam
  std::uint64_t seed = 1;  // seed of the sample order of run_adam
};

struct OptimisedNetwork {
  Eigen::VectorXd parameters;   // parameters with the least validation error
  double validation_rms = 0.0;  // infinity if no error was finite
  int iterations = 0;
  int best_iteration = 0;
};

// A StepReport is called after each iteration with the finished fraction, 0 to 1. It must not throw. If it
// returns false, the training stops.
using StepReport = std::function<bool(double share)>;

// Runs Levenberg-Marquardt with a dense analytic Jacobian, for networks of up to some hundred parameters. The
// time of an iteration is proportional to samples times parameters squared.
OptimisedNetwork run_levenberg_marquardt(const NetworkShape& shape, const NetworkSamples& samples,
                                         const Eigen::VectorXd& start, const OptimiserSettings& settings,
                                         const StepReport& report);

// Runs Adam (Kingma and Ba 2015) on mini-batches. The step increases over the first twentieth of the
// iterations and then decreases to 0 along a cosine. An iteration is one pass over the samples.
OptimisedNetwork run_adam(const NetworkShape& shape, const NetworkSamples& samples,
                          const Eigen::VectorXd& start, const OptimiserSettings& settings,
                          const StepReport& report);

// Runs L-BFGS on all samples.
OptimisedNetwork run_lbfgs(const NetworkShape& shape, const NetworkSamples& samples,
                           const Eigen::VectorXd& start, const OptimiserSettings& settings,
                           const StepReport& report);

// Returns the RMS difference of normalised outputs.
double rms_difference(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected);

}  // namespace remap
