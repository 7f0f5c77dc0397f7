// This file evaluates a fully connected network on many samples, with gradient and Jacobian by
// backpropagation, and has the optimisers of network_training.cpp. Each of them runs one training from one
// set of initial parameters. Among the files about networks, only network_optimisers.cpp uses Ceres.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "lower/mapping.hpp"

namespace remap {

struct NetworkShape {
  Activation activation = Activation::kTanh;
  std::vector<std::size_t> sizes;  // inputs, units of each hidden layer, outputs; at least two

  // Returns the number of weights and biases, which is the length of a parameter vector.
  std::size_t parameter_count() const;
};

// Splits a parameter vector into layers. Each layer has weights, in remap::Layer's order, then biases.
std::vector<Layer> layers_from_parameters(const NetworkShape& shape, const double* parameters);

// Returns 1 for each weight and 0 for each bias of a parameter vector.
Eigen::VectorXd weight_mask(const NetworkShape& shape);

// A NetworkBatch is a network of `shape` with normalised inputs. It is not thread-safe, because it keeps the
// activations of the last forward pass for the backward passes.
class NetworkBatch {
 public:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  // `inputs` has one column per sample and shape.sizes.front() rows.
  NetworkBatch(NetworkShape shape, Eigen::MatrixXd inputs);

  Eigen::Index sample_count() const noexcept { return values_.front().cols(); }

  // Replaces the samples. Their number may differ.
  void set_inputs(Eigen::MatrixXd inputs);

  // Returns the normalised outputs at `parameters`, one column per sample; valid until the next call.
  const Eigen::MatrixXd& forward(const double* parameters);

  // Computes the derivatives of output k of sample n by all parameters, in row n * outputs + k. `parameters`
  // must be those of the last forward pass.
  void jacobian(const double* parameters, Eigen::Ref<RowMajor> jacobian) const;

  // Computes the derivative by all parameters of a function whose derivatives by the outputs of the last
  // forward pass are `by_outputs` (one column per sample). `gradient` has parameter_count() numbers.
  void gradient(const double* parameters, const Eigen::MatrixXd& by_outputs, double* gradient) const;

 private:
  NetworkShape shape_;
  std::vector<std::size_t> offsets_;     // offset of each layer in a parameter vector
  std::vector<Eigen::MatrixXd> values_;  // inputs, activations of each hidden layer, outputs
  std::vector<Eigen::MatrixXd> slopes_;  // derivatives of the activation function of each hidden layer

  Eigen::Index size(std::size_t layer) const { return static_cast<Eigen::Index>(shape_.sizes[layer]); }
  Eigen::Map<const RowMajor> weights(const double* parameters, std::size_t layer) const;
  // Returns derivatives by the sums of `layer`, from the derivatives by the sums of the following layer.
  Eigen::MatrixXd before(const double* parameters, std::size_t layer, const Eigen::MatrixXd& behind) const;
};

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
