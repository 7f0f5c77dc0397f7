// A fully connected network over many samples at once: outputs, gradient and Jacobian by backpropagation.
// What the optimisers (network_optimisers.hpp) and the tests see of a network while it is trained.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "model/mapping.hpp"

namespace remapc {

struct NetworkShape {
  remap::Activation activation = remap::Activation::kTanh;
  std::vector<std::size_t> sizes;  // inputs, units of each hidden layer, outputs; at least two

  // Weights and biases of all layers: the length of a parameter vector.
  std::size_t parameter_count() const noexcept;
};

// Parameter vectors hold layer after layer: the weights as in remap::Layer, then the biases.
std::vector<remap::Layer> layers_from_parameters(const NetworkShape& shape, const double* parameters);

// 1 where a parameter is a weight, 0 where it is a bias.
Eigen::VectorXd weight_mask(const NetworkShape& shape);

// A network of `shape` bound to normalised inputs. Not for several threads at once: the activations of the
// last forward pass are kept for the backward passes that follow.
class NetworkBatch {
 public:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  // `inputs`: one column a sample, shape.sizes.front() rows.
  NetworkBatch(NetworkShape shape, Eigen::MatrixXd inputs);

  Eigen::Index sample_count() const noexcept { return values_.front().cols(); }

  // Other samples, as many as before or not.
  void set_inputs(Eigen::MatrixXd inputs);

  // Normalised outputs at `parameters`, one column a sample; valid until the next call.
  const Eigen::MatrixXd& forward(const double* parameters);

  // Of the last forward pass, at the same `parameters`: derivatives of output k of sample n by all
  // parameters, in row n * outputs + k.
  void jacobian(const double* parameters, Eigen::Ref<RowMajor> jacobian) const;

  // Of the last forward pass: derivative by all parameters of a function whose derivatives by the outputs are
  // `by_outputs` (one column a sample). `gradient` has parameter_count() numbers.
  void gradient(const double* parameters, const Eigen::MatrixXd& by_outputs, double* gradient) const;

 private:
  NetworkShape shape_;
  std::vector<std::size_t> offsets_;     // of each layer in a parameter vector
  std::vector<Eigen::MatrixXd> values_;  // inputs, activations of each hidden layer, outputs
  std::vector<Eigen::MatrixXd> slopes_;  // derivative of the activation, of each hidden layer

  Eigen::Index size(std::size_t layer) const { return static_cast<Eigen::Index>(shape_.sizes[layer]); }
  Eigen::Map<const RowMajor> weights(const double* parameters, std::size_t layer) const;
  // Derivatives by the sums of `layer` from those by the sums of the layer behind it.
  Eigen::MatrixXd before(const double* parameters, std::size_t layer, const Eigen::MatrixXd& behind) const;
};

}  // namespace remapc
