// This file evaluates a fully connected network on many samples. It computes outputs, gradient and Jacobian
// by backpropagation. The optimisers (network_optimisers.hpp) use it to train networks.
#pragma once

#include <cstddef>
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

}  // namespace remap
